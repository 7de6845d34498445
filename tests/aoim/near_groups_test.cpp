// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Updates that only near peers need use their own group of each cell, one per near row of the
// channels. Only peers within that row's distance join it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "reckon/aoim/interest/near_rows.hpp"
#include "reckon/tests/aoim/support/world.hpp"

namespace reckon::aoim {
namespace {

using namespace test;

constexpr double kSenses = 200.0;  // [m], as World's members
constexpr double kEnd = 20.0, kMiddle = 60.0;
const double kBorder = 125.0 * std::sqrt(3.0) / 2.0;  // [m] next cell, east of the origin

// Rows up to 20 m, up to 60 m, and beyond.
std::vector<Channel> rows(bool kept = false) {
  constexpr double kForever = std::numeric_limits<double>::infinity();
  std::vector<Channel> table{{kEnd, Body::full, 30.0, 1.0, 144.0, false, 1.0},
                             {kMiddle, Body::approximate, 10.0, 1.0, 144.0, false, 2.0},
                             {kForever, Body::rigid, 1.0, 1.0, 144.0, false, 4.0}};
  if (kept) table.insert(table.begin(), {1.0, Body::full, 1000.0, 1000.0, 144.0, true, 1.0});
  return table;
}

AreaOfInterestConfig with_rows() {
  AreaOfInterestConfig result = config();
  result.channels = rows();
  result.tiers = {&kDistanceKind, &kDistanceKind};
  result.radius = kSenses;
  return result;
}

GroupIndex near_group_at(const AreaOfInterestManager& manager, std::size_t row,
                         const Position& position, std::size_t pool = config().grid.pool) {
  const std::size_t number = manager.route(position).value + (row + 1) * pool;
  return {static_cast<std::uint16_t>(number)};
}

// Peers 7:1 .. 7:N, which listen at their positions.
struct Near : World {
  AreaOfInterestManager& place(const Position& at, const AreaOfInterestConfig& how = with_rows()) {
    const auto number = static_cast<std::uint16_t>(members.size() + 1);
    AreaOfInterestManager& manager = add(presence_of(number, 11u * number), at, how);
    listen(members.size() - 1);
    return manager;
  }
  SubscriptionChange listen(std::size_t member, double speed = 0.0) {
    const Focus focus{members[member].place, speed, kSenses};
    AreaOfInterestManager& manager = *members[member].manager;
    join_.clear();
    leave_.clear();
    for (std::size_t row = 0; row < manager.tiers().last_row(); ++row) {
      const auto change = manager.listen(manager.tiers().of_row(row), {&focus, 1}, now);
      follow(members[member], change);
      join_.insert(join_.end(), change.join.begin(), change.join.end());
      leave_.insert(leave_.end(), change.leave.begin(), change.leave.end());
    }
    return {join_, leave_};
  }
  void stand(std::size_t member, const Position& at) {
    members[member].place = at;
    focus(members[member]);
    listen(member);
  }
  // Sends from the first peer, in its cell.
  void say(std::uint16_t entity, std::optional<std::size_t> row) {
    const pdu::EntityState state = entity_state(entity);
    AreaOfInterestManager& first = *members[0].manager;
    row ? first.send(first.tiers().of_row(*row), StatePayload{state}, members[0].place, now)
        : first.send(kCellTier, StatePayload{state}, members[0].place, now);
    run(milliseconds(2));
  }

 private:
  std::vector<GroupIndex> join_, leave_;
};

TEST(NearGroups, ReachOnlyPeersWithinTheirRow) {
  Near world;
  world.place({0, 0, 0});
  world.place({kBorder + 15, 0, 0});
  world.place({kBorder + 50, 0, 0});
  world.place({kBorder + 90, 0, 0});
  world.run(milliseconds(200));
  world.say(1, 0);
  world.say(2, 1);
  world.say(3, std::nullopt);
  const std::array<std::array<std::size_t, 3>, 3> wanted{{{1, 1, 1}, {0, 1, 1}, {0, 0, 1}}};
  for (std::size_t member = 1; member < 4; ++member) {
    for (std::uint16_t entity = 1; entity <= 3; ++entity) {
      EXPECT_EQ(world.heard(member, entity), wanted[member - 1][entity - 1u])
          << member << " " << entity;
    }
    EXPECT_EQ(world.members[member].manager->sequences().counts().lost, 0u)
        << "each group counts alone";
  }
}

TEST(NearGroups, AreAbsentByDefault) {
  Near world;
  AreaOfInterestConfig how = with_rows();
  how.tiers.clear();
  AreaOfInterestManager& plain = world.place({0, 0, 0}, how);
  EXPECT_EQ(plain.tiers().last_row(), 0u);
  EXPECT_TRUE(world.listen(0).join.empty());
  EXPECT_FALSE(plain.subscriptions().hears(near_group_at(plain, 0, {0, 0, 0})));
}

TEST(NearGroups, MapGroupNumbersToTheirCellAndTier) {
  AreaOfInterestConfig how = with_rows();
  how.tiers.push_back(&kTouchKind);
  how.grid.pool = 100;
  const AreaOfInterestManager manager(how, presence_of(1, 11));
  const GroupIndex cell = manager.route({0, 0, 0});
  for (const std::size_t row : {0, 1}) {
    const GroupIndex group = near_group_at(manager, row, {0, 0, 0}, how.grid.pool);
    EXPECT_EQ(manager.tiers().tier_of(group), manager.tiers().of_row(row));
  }
  EXPECT_EQ(manager.tiers().tier_of(cell), kCellTier);
  EXPECT_EQ(manager.tiers().tier_of(kBaseGroup), kCellTier);
  const GroupIndex felt = near_group_at(manager, 2, {0, 0, 0}, how.grid.pool);
  EXPECT_EQ(manager.tiers().tier_of(felt), manager.tiers().urgent().front()) << "the contact group";
  EXPECT_EQ(all_groups(how), 4 * how.grid.pool);
}

// At 100 m/s, 30 m take 0.3 s: a join takes 30 ms, and the states there arrive within 100 ms after
// it.
TEST(NearGroups, AreJoinedBeforeFastFociArrive) {
  Near world;
  AreaOfInterestManager& manager = world.place({0, 0, 0});
  const GroupIndex next = near_group_at(manager, 0, {kBorder + 1, 0, 0});
  world.members[0].place = {kBorder - kEnd - 30.5, 0, 0};
  world.listen(0, 100.0);
  EXPECT_FALSE(manager.subscriptions().hears(next));
  world.members[0].place = {kBorder - kEnd - 29.5, 0, 0};
  world.listen(0, 100.0);
  EXPECT_TRUE(manager.subscriptions().hears(next));
  world.now += seconds(3);
  world.members[0].place = {kBorder - 1.05 * kEnd, 0, 0};
  world.listen(0);
  EXPECT_TRUE(manager.subscriptions().hears(next)) << "within 1.1 of it";
  world.members[0].place = {kBorder - 1.15 * kEnd, 0, 0};
  const auto change = world.listen(0);
  EXPECT_NE(std::ranges::find(change.leave, next), change.leave.end());
  EXPECT_FALSE(manager.subscriptions().hears(next));
}

TEST(NearGroups, FollowAFocusThatJumps) {
  Near world;
  AreaOfInterestManager& manager = world.place({0, 0, 0});
  world.now += seconds(3);
  world.stand(0, {5000, 5000, 0});
  EXPECT_TRUE(manager.subscriptions().hears(near_group_at(manager, 0, {5000, 5000, 0})));
  EXPECT_TRUE(manager.subscriptions().hears(near_group_at(manager, 1, {5040, 5000, 0})));
  EXPECT_TRUE(manager.subscriptions().hears(manager.route({5150, 5000, 0})));
}

// A receiver over its budget leaves the near groups of the farthest entities; kept rows stay.
TEST(NearGroups, AreLeftByReceiversOverBudget) {
  Near world;
  AreaOfInterestConfig how = with_rows();
  how.channels = rows(true);
  AreaOfInterestManager& manager = world.place({kBorder - 15, 0, 0}, how);
  const GroupIndex next = near_group_at(manager, 0, {kBorder + 1, 0, 0});
  EXPECT_TRUE(manager.subscriptions().hears(next));
  world.now += seconds(3);
  manager.set_stretch(2.0);
  world.listen(0);
  EXPECT_FALSE(manager.subscriptions().hears(next)) << "15 m count as 30";
  world.members[0].place = {kBorder - 0.5, 0, 0};
  manager.set_stretch(1000.0);
  world.listen(0);
  EXPECT_TRUE(manager.subscriptions().hears(next)) << "within the row that is kept";
}

// A peer that joins a near group requests its states; the senders introduce them in that group
// only.
TEST(NearGroups, IntroduceStatesToNewListeners) {
  Near world;
  AreaOfInterestManager& speaker = world.place({0, 0, 0});
  world.place({kBorder + 90, 0, 0});
  world.run(seconds(5));  // the start is over
  const Position here{0, 0, 0};
  const pdu::EntityId entity{7, 1, 1};
  const auto asked = [&](std::size_t row, nanoseconds told) {
    return speaker.must_send(speaker.tiers().of_row(row), entity, here, {told, {}}, world.now);
  };
  const nanoseconds long_ago = nanoseconds::min() / 2;
  EXPECT_FALSE(asked(0, long_ago) || asked(1, long_ago));
  world.stand(1, {kBorder + 50, 0, 0});
  world.run(milliseconds(150));
  EXPECT_TRUE(asked(1, long_ago));
  EXPECT_FALSE(asked(1, world.now)) << "told since";
  EXPECT_FALSE(asked(0, long_ago)) << "nobody listens there";
  EXPECT_FALSE(
      speaker.must_send(kCellTier, entity, here, {long_ago, speaker.route(here)}, world.now))
      << "not all are to be told";
  world.stand(1, {kBorder + 15, 0, 0});
  world.run(milliseconds(150));
  EXPECT_TRUE(asked(0, long_ago));
}

// A near group refuses the same datagrams as the group of its cell.
TEST(NearGroups, RefuseTheSameDatagramsAsCellGroups) {
  Near world;
  AreaOfInterestManager& manager = world.place({0, 0, 0});
  world.run(milliseconds(10));
  manager.receive(kBaseGroup, encoded(presence_of(2, 22)), world.now, source(2));
  AreaOfInterestManager other(with_rows(), presence_of(2, 22));
  Collector wire;
  other.send(other.tiers().of_row(0), StatePayload{entity_state(1)}, {0.3, 0, 0}, world.now);
  other.step(world.now, wire);
  ASSERT_EQ(wire.datagrams.size(), 1u);
  const auto& [group, octets] = wire.datagrams[0];
  EXPECT_EQ(group, near_group_at(manager, 0, {0.3, 0, 0}));
  const auto verdict = [&](GroupIndex where, const Octets& what,
                           const SourceAddress& from = source(2)) {
    return manager.receive(where, what, world.now, from).verdict;
  };
  EXPECT_EQ(verdict(group, octets, source(3)), IncomingVerdict::impostor);
  EXPECT_EQ(verdict(group, octets), IncomingVerdict::use);
  EXPECT_EQ(verdict(group, octets), IncomingVerdict::duplicate);
  const GroupIndex far = near_group_at(manager, 0, {500, 0, 0});
  EXPECT_EQ(verdict(far, octets), IncomingVerdict::not_joined);
  EXPECT_EQ(verdict(near_group_at(manager, 2, {0, 0, 0}), octets), IncomingVerdict::not_joined);
  EXPECT_EQ(verdict({60000}, octets), IncomingVerdict::not_joined);
  Octets of_others = octets;
  of_others[of_others.size() - pdu::kDatagramTrailerSize + 1] = std::byte{99};
  EXPECT_EQ(verdict(group, of_others), IncomingVerdict::other_exercise);
}

TEST(NearGroups, IgnoreMembershipsOfUnknownRows) {
  Near world;
  AreaOfInterestManager& manager = world.place({0, 0, 0});
  world.run(milliseconds(1500));
  pdu::CellMembership strange;
  strange.simulation = {7, 2};
  strange.epoch = 22;
  strange.action = pdu::MembershipAction::join_near;
  std::array<std::byte, pdu::kFixedSize<pdu::CellIndex>> cell{};
  strange.cells = cell;
  for (const unsigned row : {2u, 17u, 255u}) {
    strange.near_row = static_cast<std::uint8_t>(row);
    manager.receive(kBaseGroup, encoded(strange), world.now, source(2));
    EXPECT_FALSE(manager.introductions().is_pending()) << row;
  }
  strange.near_row = 1;
  manager.receive(kBaseGroup, encoded(strange), world.now, source(2));
  EXPECT_TRUE(manager.introductions().is_pending());
}

TEST(NearGroups, AreRefusedInImpossibleConfigurations) {
  const auto refused = [](auto change) {
    AreaOfInterestConfig how = with_rows();
    change(how);
    EXPECT_THROW(AreaOfInterestManager(how, presence_of(1, 11)), std::invalid_argument);
  };
  refused([](auto& how) { how.interop = true; });
  refused([](auto& how) { how.leader.on = true; });
  refused([](auto& how) { how.leader.on = how.leader.hand_out = true; });
  refused([](auto& how) { how.grid.pool = 1; });
  refused([](auto& how) { how.grid.pool = kMaximumPool / 3 + 1; });
  refused([](auto& how) { how.channels.clear(); });
  refused([](auto& how) { how.channels.erase(how.channels.begin(), how.channels.begin() + 2); });
  refused([](auto& how) { how.channels.front().coarser = 2.0; });
  refused([](auto& how) { how.tiers.pop_back(); });
  AreaOfInterestConfig most = with_rows();
  most.grid.pool = kMaximumPool / 3;
  EXPECT_NO_THROW(AreaOfInterestManager(most, presence_of(1, 11)));
}

TEST(NearGroups, ReachNoFartherThanTheirRowOrFocus) {
  const ChannelTable table(rows());
  const auto reach = [&](double radius) {
    return near_focus(table, 1, {{}, 0.0, radius}, kSenses, 1.0).radius;
  };
  EXPECT_EQ(reach(kSenses), kMiddle);
  EXPECT_EQ(reach(kSenses + 5.0), kMiddle + 5.0);  // represents several entities, 5 m apart
  EXPECT_EQ(reach(10.0), 10.0);
  EXPECT_EQ(reach(100.0), kMiddle);
}

}  // namespace
}  // namespace reckon::aoim
