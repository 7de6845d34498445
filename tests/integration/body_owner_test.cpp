// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Only its owner states a body of the scene: forged states, and those of other members, move
// nothing and press no hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/tests/integration/owners_exercise.hpp"

namespace reckon::test {
namespace {

using testing::Contains;
using testing::HasSubstr;

constexpr std::size_t kFirst = 0, kSecond = 1, kThief = 2, kLinks = 3;

haptics::HandTarget wait_at(double x) {
  haptics::HandTarget target;
  target.position = {x, 0, 0.02};
  return target;
}

/// A member that states the cube 0.1 m from its place in each pass, as if it owned it.
class Claims final : public peer::ModelGuest {
 public:
  explicit Claims(const pdu::OwnershipRecord& record) : record_(record) {}
  void begin_pass(peer::ModelLoop& loop) noexcept override {
    const auto number = static_cast<peer::EntityNumber>(1);
    peer::OwnedEntity* cube = loop.find_own(number);
    ASSERT_NE(cube, nullptr);
    cube->own_by(record_);
    peer::EntityTruth truth;
    truth.time = loop.pass().now;
    truth.position = {0.1, 0, 0.02};
    ASSERT_TRUE(loop.move(number, truth));
    cube->event();
  }
  void receive(const pdu::PduHeader&, std::span<const std::byte>,
               const peer::InteractionSender&) noexcept override {}
  void end_pass(peer::ModelLoop&) noexcept override {}
  void note_undelivered(const peer::Undelivered&) noexcept override {}

 private:
  pdu::OwnershipRecord record_;
};

/// A first peer whose hand is far from its cube, and a second whose hand waits 0.1 m beside it.
class Exercise : public OwnersExercise {
 public:
  explicit Exercise(const std::string& network = "")
      : OwnersExercise(kLinks, cubes_scene(1, 0.02, network)) {}

  void start_first() {
    start_with_hand(kFirst, 1, [](double) { return wait_at(-0.5); });
  }
  void start_second() {
    start_with_hand(kSecond, 2, [](double) { return wait_at(0.1); });
  }
  /// @return the largest force on the second peer's hand meanwhile [N]
  double run(std::size_t steps) {
    double felt = 0.0;
    for (std::size_t i = 0; i < steps; ++i) {
      step();
      if (!lives(kSecond)) continue;
      peer(kSecond).views().update();
      felt = std::max(felt, peer(kSecond).views().read().servo().force.norm());
    }
    return felt;
  }
  /// From now on the thief's link, without a peer, receives what the others send.
  void eavesdrop() {
    const peer::GroupPool pool = peer::pool_of(scene());
    static_cast<void>(network().link(kThief).join(pool.base()));
    for (std::size_t i = 0; i < pool.size(); ++i)
      static_cast<void>(network().link(kThief).join(pool.address(i)));
  }
  /// The thief's link sends the received states of the cube again, 3 m from their place and with
  /// later sequence numbers.  @return their number
  std::size_t forge() {
    std::size_t forged = 0;
    std::array<peer::Datagram, 64> datagrams;
    const std::size_t count = network().link(kThief).receive(datagrams);
    for (const peer::Datagram& datagram : std::span(datagrams).first(count)) {
      std::vector<std::byte> octets(datagram.bytes.begin(), datagram.bytes.end());
      pdu::EntityState state;
      if (pdu::decode(octets, state) != pdu::DecodeError::none ||
          state.entity_id != peer::body_id(0))
        continue;
      state.location.x += 3.0;
      EXPECT_GT(pdu::encode(state, octets), 0u);
      octets[octets.size() - 10] ^= std::byte{1};  // of the sequence number
      forged += network().link(kThief).send(datagram.group, octets) ? 1 : 0;
    }
    return forged;
  }
  [[nodiscard]] const peer::RemoteEntity* cube_row() {
    return peer(kSecond).model().remote().find(peer::body_id(0));
  }
  [[nodiscard]] double cube_at() { return shown(kSecond, 0).position.x(); }
};

TEST(BodyOwner, AMemberThatClaimsItMovesNothing) {
  const std::uint64_t versions[]{
      0, 1, 1ULL << 32, 2ULL << 32, (2ULL << 32) + 1, (2ULL << 32) + 999, 900ULL << 32, ~0ULL};
  for (const std::uint64_t version : versions) {
    Exercise exercise;
    exercise.start_first();
    exercise.start_second();
    exercise.start(kThief, 3);
    exercise.run(2000);
    pdu::OwnershipRecord record;
    record.owner = exercise.epoch(kThief);
    record.version = version;
    Claims claims(record);
    exercise.peer(kThief).model().set_guest(&claims);
    EXPECT_EQ(exercise.run(2000), 0.0) << version;
    EXPECT_NEAR(exercise.cube_at(), 0.0, 1e-4) << version;
    EXPECT_GT(exercise.count(kSecond, "bodies_disputed"), 0u) << version;
    EXPECT_THAT(exercise.notices(kSecond),
                Contains(HasSubstr("a body of the scene comes only from its owner")));
    exercise.owners(kSecond).acquire(0);
    exercise.run(500);
    EXPECT_TRUE(exercise.simulates(kSecond, 0)) << "the thief is no obstacle, " << version;
    exercise.peer(kThief).model().set_guest(nullptr);
  }
}

TEST(BodyOwner, ForgedAddressMovesNothing) {
  Exercise exercise;
  exercise.eavesdrop();
  exercise.start_second();
  exercise.start_first();
  std::size_t forged = 0;
  for (int i = 0; i < 100; ++i) {
    exercise.run(20);
    forged += exercise.forge();
  }
  EXPECT_GT(forged, 0u);
  ASSERT_NE(exercise.cube_row(), nullptr);
  EXPECT_LT(exercise.cube_row()->state->position.norm(), 0.1);
  EXPECT_NEAR(exercise.cube_at(), 0.0, 1e-4);
  EXPECT_GE(exercise.count(kSecond, "datagrams_refused"), forged);
}

TEST(BodyOwner, RestartedOwnerTakesTheRow) {
  Exercise exercise;
  exercise.start_second();
  exercise.start_first();
  exercise.run(1000);
  ASSERT_NE(exercise.cube_row(), nullptr);
  const auto first_heard = exercise.cube_row()->first_heard;
  const std::uint32_t epoch = exercise.cube_row()->epoch;
  exercise.peer(kFirst).stop(exercise.now(), exercise.utc_now());
  exercise.kill(kFirst);
  exercise.run(70'000);  // longer than any time-out
  ASSERT_NE(exercise.cube_row(), nullptr);
  EXPECT_NE(exercise.cube_row()->doubted_at, peer::RemoteEntity::kTrusted);
  exercise.start_first();
  exercise.run(1000);
  ASSERT_NE(exercise.cube_row(), nullptr);
  EXPECT_NE(exercise.cube_row()->epoch, epoch);
  EXPECT_EQ(exercise.cube_row()->first_heard, first_heard) << "the same row";
  EXPECT_EQ(exercise.cube_row()->doubted_at, peer::RemoteEntity::kTrusted);
}

TEST(BodyOwner, NobodyTakesTheSceneSite) {
  const peer::SceneFile scene = scene_of(cubes_scene(1));
  peer::ManualClock clock(seconds(1), std::chrono::hours(1));
  peer::SimulatedNetwork network({.links = 1}, clock);
  peer::PeerOptions own;
  own.site = 65534;
  try {
    const peer::Peer peer(scene, own, network.link(0), std::span<const peer::PeerDevice>());
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("site 65534 belongs to the scene's bodies"));
  }
  for (const std::string_view key : {"touch", "allow_management"}) {
    try {
      static_cast<void>(scene_of(cubes_scene(1, 0.02, std::string(key) + " = \"65534:1\"")));
      FAIL() << "accepted";
    } catch (const peer::SceneFileError& error) {
      EXPECT_THAT(error.what(), HasSubstr("site 65534, which belongs to the scene's bodies"));
    }
  }
}

// The older world has precedence.
TEST(BodyOwner, IsTheFirstOfTwoFounders) {
  Exercise exercise;
  exercise.start_first();
  exercise.start_second();
  exercise.run(3000);
  peer::Peer& late = exercise.start(kThief, 1);
  haptics::BodyOrder place{haptics::BodyAct::place, 0};
  place.state.position = {0.1, 0, 0.02};
  ASSERT_NE(late.bodies()->exchange().send(std::span(&place, 1)), 0u);
  EXPECT_EQ(exercise.run(4000), 0.0);
  EXPECT_NEAR(exercise.cube_at(), 0.0, 1e-4);
  EXPECT_NEAR(exercise.shown(kThief, 0).position.x(), 0.0, 1e-4);
  EXPECT_THAT(exercise.notices(kThief), Contains(HasSubstr("own the bodies again together")));
}

TEST(BodyOwner, IsFeltOnlyIfTouchAdmitsIt) {
  for (const bool admitted : {true, false}) {
    Exercise exercise(admitted ? "touch = [\"1:2\", \"1:3\"]" : "touch = [\"1:2\"]");
    exercise.start_second();
    peer::Peer& first = exercise.start(kThief, 1);
    haptics::BodyOrder place{haptics::BodyAct::place, 0};
    place.state.position = {0.1, 0, 0.02};
    ASSERT_NE(first.bodies()->exchange().send(std::span(&place, 1)), 0u);
    const double felt = exercise.run(3000);
    EXPECT_EQ(felt > 0.0, admitted) << felt;
    EXPECT_EQ(exercise.count(kSecond, "touch_refused") > 0, !admitted);
  }
}

TEST(BodyOwner, IsNamedInAnInteropExercise) {
  for (const bool named : {false, true}) {
    Exercise exercise(named ? "interop = true\ntouch = [\"1:3\"]" : "interop = true");
    exercise.start_second();
    peer::Peer& first = exercise.start(kThief, 1);
    haptics::BodyOrder place{haptics::BodyAct::place, 0};
    place.state.position = {0.1, 0, 0.02};
    ASSERT_NE(first.bodies()->exchange().send(std::span(&place, 1)), 0u);
    const double felt = exercise.run(3000);
    EXPECT_EQ(felt > 0.0, named) << felt;
  }
}

}  // namespace
}  // namespace reckon::test
