// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The newest state wins at a peer whose updates arrive faster than it processes them: all queued
// states of an entity cost one update, and the newest is shown.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "reckon/pdu/timestamp.hpp"
#include "reckon/tests/support/in_process.hpp"

namespace reckon::test {
namespace {

// A peer, and a plain DIS program on link 1 that sends 500 states of each of two entities within a
// millisecond.
class Overtaken : public testing::Test {
 protected:
  explicit Overtaken(const std::string& network = {}, std::size_t in_flight = 1024)
      : scene_(scene_of(with(kTwoHandsOnAWall, "[hand]", "[network]\n" + network + "\n[hand]"))),
        world_(3, 1, in_flight) {
    world_.listen(scene_);
    world_.start(0, scene_);
    world_.run(50);
    for (const pdu::EntityState& state : world_.heard_pdus<pdu::EntityState>()) state_ = state;
    state_.header.exercise_id = scene_.network.exercise;
    state_.header.pdu_status = 0;
    state_.variable_parameters = {};
    state_.entity_type = {pdu::EntityKind::platform, pdu::EntityDomain::air};
    state_.dead_reckoning.algorithm = pdu::DeadReckoningAlgorithm::static_;
  }

  void say(std::uint16_t entity, int place) {
    say_of(entity, std::chrono::microseconds(500 * (kStates - place)), place);
  }
  void say_of(std::uint16_t entity, std::chrono::microseconds ago, int place) {
    state_.entity_id = {7, 7, entity};
    state_.header.timestamp = pdu::to_dis_timestamp(world_.clock().utc_now() - ago, true);
    pdu::EntityState state = state_;
    state.location.x += 0.001 * place;
    std::vector<std::byte> octets(pdu::wire_size(state));
    ASSERT_EQ(pdu::encode(state, octets), octets.size());
    ASSERT_TRUE(world_.network().link(1).send(scene_.network.group, octets));
  }
  void flood() {
    for (int place = 0; place < kStates; ++place) {
      say(1, place);
      say(2, place);
    }
    world_.run(20);
  }
  [[nodiscard]] const peer::RemoteEntity* row(std::uint16_t entity) {
    return world_.peer(0).model().remote().find({7, 7, entity});
  }

  static constexpr int kStates = 500;
  peer::SceneFile scene_;
  InProcess world_;
  pdu::EntityState state_;
};

TEST_F(Overtaken, StatesCostOneUpdateABatch) {
  flood();
  EXPECT_EQ(world_.count(0, "updates_in") + world_.count(0, "overtaken_in"), 2U * kStates);
  EXPECT_LE(world_.count(0, "updates_in"), 2U * 10);
  EXPECT_EQ(world_.count(0, "stale_in"), 0U);
  EXPECT_EQ(world_.count(0, "pdus_in"), 2U * kStates);
}

TEST_F(Overtaken, StatesLeaveTheNewestShown) {
  flood();
  say(3, 0);
  say(3, kStates - 1);
  world_.run(2);
  ASSERT_NE(row(1), nullptr);
  ASSERT_NE(row(3), nullptr);
  EXPECT_EQ(row(1)->state->position, row(3)->state->position);
  EXPECT_EQ(row(2)->state->position, row(3)->state->position);
}

TEST_F(Overtaken, StatesTakenAtOnceAreNotOvertaken) {
  for (int place = 0; place < 100; ++place) {
    say(1, place);
    world_.run(1);
  }
  EXPECT_EQ(world_.count(0, "updates_in"), 100U);
  EXPECT_EQ(world_.count(0, "overtaken_in"), 0U);
}

// A link that holds more datagrams than one pass looks through.
class FarOvertaken : public Overtaken {
 protected:
  FarOvertaken() : Overtaken({}, 4096) {}

  /// Sends `states` states of one entity, 100 us apart.
  void say_of_one(int states, int ago_ms) {
    for (int i = 0; i < states; ++i)
      say_of(1, std::chrono::microseconds(1000 * ago_ms - 100 * i), i);
  }
  void say_of_each(int ago_ms) {
    for (std::uint16_t entity = 2; entity < 2 + kEntities; ++entity)
      say_of(entity, std::chrono::milliseconds(ago_ms), ago_ms);
  }
  static constexpr int kEntities = 384;
};

// After 512 overtaken ones, 1,408 queued datagrams are searched: the first state of each of 384
// entities is overtaken by one that follows 1,024 datagrams later.
TEST_F(FarOvertaken, StatesAreFoundThroughoutARing) {
  say_of_one(512, 400);
  say_of_each(300);
  say_of_one(640, 250);
  say_of_each(100);
  world_.run(5);
  EXPECT_EQ(world_.count(0, "updates_in"), 2U + kEntities);
  EXPECT_EQ(world_.count(0, "overtaken_in"), 512U + 640U - 2U + kEntities);
}

// A state may be the key of others.
class OvertakenKeys : public Overtaken {
 protected:
  OvertakenKeys() : Overtaken("compression = \"residual\"\n") {}
};

TEST_F(OvertakenKeys, AreTaken) {
  flood();
  EXPECT_EQ(world_.count(0, "updates_in"), 2U * kStates);
  EXPECT_EQ(world_.count(0, "overtaken_in"), 0U);
}

}  // namespace
}  // namespace reckon::test
