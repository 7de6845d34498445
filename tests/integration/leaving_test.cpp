// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Peers that depart, die, and return.
#include <gtest/gtest.h>

#include "reckon/pdu/reckon/presence_pdu.hpp"
#include "reckon/tests/support/in_process.hpp"

namespace reckon::test {
namespace {

class Leaving : public testing::Test {
 protected:
  Leaving() : scene_(scene_of(kTwoHandsOnAWall)), world_(3) {
    world_.listen(scene_);
    for (std::size_t link : {0u, 1u, 2u}) world_.start(link, scene_);
    const auto all_seen = [&] {
      return world_.view(0).entities == 2 && world_.view(1).entities == 2 &&
             world_.view(2).entities == 2;
    };
    EXPECT_LE(world_.run_until(all_seen, 1000), 999u) << "a remote entity is shown within 1 s";
    world_.run(500);
  }
  std::size_t ms_until_entities(std::size_t link, std::size_t count, std::size_t limit) {
    return world_.run_until([&] { return world_.view(link).entities == count; }, limit);
  }

  peer::SceneFile scene_;
  InProcess world_;
};

TEST_F(Leaving, SendsADeactivatedStateAndAGoodbye) {
  const pdu::EntityId id = world_.peer(1).own_id();
  world_.heard().clear();
  world_.stop(1);
  world_.run(20);
  int deactivated = 0;
  for (const auto& state : world_.heard_pdus<pdu::EntityState>()) {
    if (state.entity_id != id) continue;
    EXPECT_NE(state.appearance & pdu::kAppearanceDeactivated, 0u);
    ++deactivated;
  }
  EXPECT_EQ(deactivated, 1);
  int goodbyes = 0;
  for (const auto& presence : world_.heard_pdus<pdu::Presence>()) {
    goodbyes += (presence.flags & pdu::kPresenceLeaving) != 0 ? 1 : 0;
  }
  EXPECT_EQ(goodbyes, 1);
}

TEST_F(Leaving, RemovesADepartedPeersRowAtOnce) {
  world_.stop(1);
  EXPECT_LE(ms_until_entities(0, 1, 100), kPicture / milliseconds(1) + 4);
  EXPECT_EQ(world_.count(0, "left"), 1u);
  EXPECT_EQ(world_.count(0, "timed_out"), 0u);
}

TEST_F(Leaving, DropsOneThatDiesWithinThePresenceTimeout) {
  world_.kill(1);
  const std::size_t after = ms_until_entities(0, 1, 10'000);
  // Its last announcement was at most one second before its death.
  EXPECT_GE(after, (kPresenceTimeout - seconds(1)) / milliseconds(1));
  EXPECT_LE(after, (kPresenceTimeout + kPicture) / milliseconds(1) + 2);
  EXPECT_EQ(world_.count(0, "timed_out"), 1u);
}

TEST_F(Leaving, SurvivorsLoseNothingOfOneAnother) {
  for (std::size_t victim : {0u, 1u, 2u}) {
    SCOPED_TRACE(victim);
    world_.kill(victim);
    std::vector<std::size_t> survivors;
    for (std::size_t link : {0u, 1u, 2u}) {
      if (link != victim) survivors.push_back(link);
    }
    std::vector<std::uint64_t> before;
    for (const std::size_t link : survivors) before.push_back(world_.count(link, "updates_in"));
    world_.run(7000);
    for (std::size_t i = 0; i < survivors.size(); ++i) {
      EXPECT_EQ(world_.view(survivors[i]).entities, 1u);
      EXPECT_EQ(world_.count(survivors[i], "datagrams_lost"), 0u);
      EXPECT_GT(world_.count(survivors[i], "updates_in"), before[i]);
    }
    world_.start(victim, scene_, static_cast<std::uint32_t>(200 + victim),
                 static_cast<std::uint16_t>(1 + victim));
    EXPECT_LE(ms_until_entities(victim, 2, 1000), 999u) << "not back within 1 s";
    world_.run(1000);
  }
}

TEST_F(Leaving, RestartedPeerIsKnownInItsNewEpoch) {
  world_.kill(1);
  world_.run(200);
  static_cast<void>(world_.notices(0));
  world_.start(1, scene_, 4711, 2);
  EXPECT_LE(ms_until_entities(1, 2, 1000), 999u);
  world_.run(1000);
  EXPECT_EQ(world_.view(0).entities, 2u);
  const auto told = world_.notices(0);
  ASSERT_FALSE(told.empty());
  EXPECT_NE(told[0].find("restarted"), std::string::npos) << told[0];
}

TEST_F(Leaving, NothingOfAFormerLifeIsUsed) {
  // Records the datagrams of peer 1, then replays them after its restart.
  world_.heard().clear();
  world_.run(1000);
  std::vector<Heard> former;
  for (const Heard& datagram : world_.heard()) {
    if (datagram.sender == world_.network().link(1).local_endpoint()) former.push_back(datagram);
  }
  ASSERT_FALSE(former.empty());
  world_.kill(1);
  world_.start(1, scene_, 4711, 2);
  world_.run(1000);
  const auto before = world_.count(0, "datagrams_refused");
  for (const Heard& datagram : former) {
    static_cast<void>(world_.network().link(3).send(datagram.group, datagram.octets));
  }
  world_.run(2);
  EXPECT_EQ(world_.count(0, "datagrams_refused") - before, former.size());
}

}  // namespace
}  // namespace reckon::test
