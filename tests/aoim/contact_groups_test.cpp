// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Touchable entities use a second group of their cell. Only peers that can touch them join it.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "reckon/tests/aoim/support/world.hpp"

namespace reckon::aoim {
namespace {

using namespace test;

constexpr double kReach = 0.5;  // [m]
constexpr std::size_t kTouchTier = 1;

AreaOfInterestConfig with_contacts() {
  AreaOfInterestConfig result = config();
  result.tiers = {&kTouchKind};
  return result;
}

GroupIndex contact_group_at(const AreaOfInterestManager& manager, const Position& position) {
  const GroupIndex cell = manager.route(position);
  return {static_cast<std::uint16_t>(cell.value + config().grid.pool)};
}

// Peers 7:1 .. 7:N, each with a touchable entity at its position.
struct Hands : World {
  AreaOfInterestManager& place(const Position& at, const AreaOfInterestConfig& how) {
    const auto number = static_cast<std::uint16_t>(members.size() + 1);
    AreaOfInterestManager& manager = add(presence_of(number, 11u * number), at, how);
    reach_from(at, members.size() - 1);
    return manager;
  }
  SubscriptionChange reach_from(const Position& at, std::size_t member, double speed = 0.0) {
    const Focus focus{at, speed, kReach};
    const auto change = members[member].manager->listen(kTouchTier, {&focus, 1}, now);
    follow(members[member], change);
    return change;
  }
  void say(std::uint16_t entity, bool felt) {
    pdu::EntityState state = entity_state(entity);
    AreaOfInterestManager& first = *members[0].manager;
    felt ? first.send(kTouchTier, StatePayload{state}, members[0].place, now)
         : first.send(kCellTier, StatePayload{state}, members[0].place, now);
    run(milliseconds(2));
  }
};

TEST(ContactGroups, ReachOnlyPeersWithinReach) {
  Hands world;
  world.place({0, 0, 0}, with_contacts());
  world.place({0.3, 0, 0}, with_contacts());
  world.place({150, 0, 0}, with_contacts());
  world.run(milliseconds(200));
  world.say(1, true);
  world.say(2, false);
  EXPECT_EQ(world.heard(1, 1), 1u);
  EXPECT_EQ(world.heard(1, 2), 1u);
  EXPECT_EQ(world.heard(2, 1), 0u);
  EXPECT_EQ(world.heard(2, 2), 1u);
  EXPECT_EQ(world.members[1].manager->sequences().counts().lost, 0u);
  EXPECT_EQ(world.members[2].manager->sequences().counts().lost, 0u) << "each group counts alone";
}

TEST(ContactGroups, AreAbsentByDefault) {
  Hands world;
  AreaOfInterestManager& plain = world.place({0, 0, 0}, config());
  EXPECT_TRUE(plain.tiers().urgent().empty());
  EXPECT_TRUE(world.reach_from({0, 0, 0}, 0).join.empty());
  EXPECT_FALSE(plain.subscriptions().hears(contact_group_at(plain, {0, 0, 0})));
  EXPECT_EQ(plain.send(kTouchTier, StatePayload{entity_state(1)}, {0, 0, 0}, world.now),
            AddResult::refused_group);
  EXPECT_FALSE(plain.must_send(kTouchTier, {7, 1, 1}, {0, 0, 0}, {}, world.now));
}

// The corner radius of a cell is 125 m: the next cell begins 108.25 m east.
TEST(ContactGroups, AreJoinedBeforeArrivalAndLeftLate) {
  Hands world;
  AreaOfInterestManager& manager = world.place({0, 0, 0}, with_contacts());
  const GroupIndex next = contact_group_at(manager, {110, 0, 0});
  const std::size_t groups = manager.subscriptions().joined_groups();
  const double border = 125.0 * std::sqrt(3.0) / 2.0, ahead = 2.0 * 0.1;  // at 2 m/s
  world.reach_from({border - kReach - ahead - 0.01, 0, 0}, 0, 2.0);
  EXPECT_FALSE(manager.subscriptions().hears(next));
  world.reach_from({border - kReach - ahead + 0.01, 0, 0}, 0, 2.0);
  EXPECT_TRUE(manager.subscriptions().hears(next)) << "a join takes up to 30 ms";
  EXPECT_EQ(manager.subscriptions().joined_groups(), groups + 1);
  EXPECT_FALSE(manager.subscriptions().hears(contact_group_at(manager, {-110, 0, 0})));

  world.now += seconds(3);
  world.reach_from({border - 1.9 * kReach, 0, 0}, 0);
  EXPECT_TRUE(manager.subscriptions().hears(next)) << "within twice the reach";
  const auto change = world.reach_from({0, 0, 0}, 0);
  ASSERT_EQ(change.leave.size(), 1u);
  EXPECT_EQ(change.leave[0], next);
  EXPECT_FALSE(manager.subscriptions().hears(next));
}

TEST(ContactGroups, AreJoinedBeyondTheCapOfOtherGroups) {
  AreaOfInterestConfig how = with_contacts();
  how.subscription.maximum_groups = 1;
  Hands world;
  AreaOfInterestManager& manager = world.place({0, 0, 0}, how);
  world.reach_from({125.0 * std::sqrt(3.0) / 2.0, 0, 0}, 0);
  EXPECT_TRUE(manager.subscriptions().hears(contact_group_at(manager, {107, 0, 0})));
  EXPECT_TRUE(manager.subscriptions().hears(contact_group_at(manager, {110, 0, 0})));
  EXPECT_EQ(manager.subscriptions().cells().joined().size(), 1u);
}

TEST(ContactGroups, CountNoLossWhileTheyAreNotJoined) {
  Hands world;
  world.place({0, 0, 0}, with_contacts());
  world.place({0.3, 0, 0}, with_contacts());
  world.run(milliseconds(200));
  world.say(1, true);
  world.now += seconds(3);
  world.reach_from({150, 0, 0}, 1);
  for (std::uint16_t i = 2; i < 12; ++i) world.say(i, true);
  world.reach_from({0.3, 0, 0}, 1);
  world.say(12, true);
  EXPECT_EQ(world.heard(1, 5), 0u);
  EXPECT_EQ(world.heard(1, 12), 1u);
  EXPECT_EQ(world.members[1].manager->sequences().counts().lost, 0u);
}

// A contact group refuses the same datagrams as the group of its cell.
TEST(ContactGroups, RefuseTheSameDatagramsAsCellGroups) {
  Hands world;
  AreaOfInterestManager& manager = world.place({0, 0, 0}, with_contacts());
  world.run(milliseconds(10));
  manager.receive(kBaseGroup, encoded(presence_of(2, 22)), world.now, source(2));
  AreaOfInterestManager other(with_contacts(), presence_of(2, 22));
  Collector wire;
  other.send(kTouchTier, StatePayload{entity_state(1)}, {0.3, 0, 0}, world.now);
  other.step(world.now, wire);
  ASSERT_EQ(wire.datagrams.size(), 1u);
  const auto& [group, octets] = wire.datagrams[0];
  EXPECT_EQ(group, contact_group_at(manager, {0.3, 0, 0}));
  const auto verdict = [&](GroupIndex where, const Octets& what,
                           const SourceAddress& from = source(2)) {
    return manager.receive(where, what, world.now, from).verdict;
  };
  EXPECT_EQ(verdict(group, octets, source(3)), IncomingVerdict::impostor);
  EXPECT_EQ(verdict(group, octets), IncomingVerdict::use);
  EXPECT_EQ(verdict(group, octets), IncomingVerdict::duplicate);
  const GroupIndex next = contact_group_at(manager, {110, 0, 0});
  EXPECT_EQ(verdict(next, octets), IncomingVerdict::not_joined);
  EXPECT_EQ(verdict({60000}, octets), IncomingVerdict::not_joined);
  Octets of_others = octets;
  of_others[of_others.size() - pdu::kDatagramTrailerSize + 1] = std::byte{99};
  EXPECT_EQ(verdict(group, of_others), IncomingVerdict::other_exercise);
}

TEST(ContactGroups, AreRefusedInImpossibleConfigurations) {
  const auto refused = [](auto change) {
    AreaOfInterestConfig how = with_contacts();
    change(how);
    EXPECT_THROW(AreaOfInterestManager(how, presence_of(1, 11)), std::invalid_argument);
  };
  refused([](auto& how) { how.interop = true; });
  refused([](auto& how) { how.leader.on = how.leader.hand_out = true; });
  refused([](auto& how) { how.grid.pool = 1; });
  refused([](auto& how) { how.grid.pool = kMaximumPool / 2 + 1; });
  AreaOfInterestConfig most = with_contacts();
  most.grid.pool = kMaximumPool / 2;
  EXPECT_NO_THROW(AreaOfInterestManager(most, presence_of(1, 11)));
}

}  // namespace
}  // namespace reckon::aoim
