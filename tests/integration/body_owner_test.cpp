// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The first peer owns the bodies of a scene: other peers' states of them move nothing and press no
// hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/peer/world/shared_bodies.hpp"
#include "reckon/tests/support/in_process.hpp"

namespace reckon::test {
namespace {

using testing::Contains;
using testing::HasSubstr;

constexpr std::string_view kCube = R"(
[[object]]
name = "floor"
plane = [0, 0, 1]
surface = {stiffness = "400 N/m"}

[[object]]
name = "cube"
box = "40 40 40 mm"
position = "0 0 20 mm"
mass = "50 g"
body_friction = 0.4
surface = {stiffness = "400 N/m"}

[network]
TOUCH

[[operator]]
passive = true

[[device]]
peer = 1
operator = 1

[[device]]
peer = 2
operator = 1
)";

constexpr std::size_t kFirst = 0, kSecond = 1, kThief = 2, kLinks = 3;

haptics::HandTarget wait_at(double x) {
  haptics::HandTarget target;
  target.position = {x, 0, 0.02};
  return target;
}

/// A first peer whose hand is far from its cube, a second whose hand waits 0.1 m beside it, and a
/// thief that puts a cube of its own into the second hand.
class Exercise {
 public:
  explicit Exercise(const std::string& network = "")
      : clock_(seconds(1), std::chrono::hours(1)),
        network_({.links = kLinks}, clock_),
        scene_(scene_of(with(kCube, "TOUCH", network))) {}

  // By its number in the scene.
  void start(std::size_t link, std::uint8_t scene_peer) {
    peer::PeerOptions own;
    own.application = static_cast<std::uint16_t>(link + 1);
    own.epoch = ++lives_;
    own.scene_peer = scene_peer;
    if (link == kThief) {
      peers_[link] = std::make_unique<peer::Peer>(scene_, own, network_.link(link),
                                                  std::span<const peer::PeerDevice>());
      place_stolen_cube(*peers_[link], scene_peer);
    } else {
      const auto still = [link](double) { return wait_at(link == kFirst ? -0.5 : 0.1); };
      haptics::SimulatedDeviceConfig config;
      config.hand_stiffness = 300;
      config.start = still(0).position;
      hands_[link] = std::make_unique<haptics::SimulatedDevice>(config, still);
      peers_[link] = std::make_unique<peer::Peer>(scene_, own, network_.link(link), *hands_[link]);
    }
    peers_[link]->start(clock_.now());
  }
  // As the first peer the thief simulates the cube; otherwise it states it without a right.
  void place_stolen_cube(peer::Peer& thief, std::uint8_t scene_peer) {
    const Eigen::Vector3d place(0.1, 0, 0.02);
    if (scene_peer == 1) {
      haptics::BodyOrder order;
      order.act = haptics::BodyAct::place;
      order.state.position = place;
      ASSERT_NE(thief.bodies()->exchange().send(std::span(&order, 1)), 0u);
      return;
    }
    thief.model().add_bodies(1);
    peer::EntityTruth cube;
    cube.time = clock_.now();
    cube.position = place;
    ASSERT_TRUE(thief.model().move(1, cube));
  }
  void stop(std::size_t link) {
    peers_[link]->stop(clock_.now(), clock_.utc_now());
    peers_[link].reset();
  }
  void kill(std::size_t link) { peers_[link].reset(); }
  /// @return the largest force on the second peer's hand meanwhile [N]
  double run(std::size_t steps) {
    double felt = 0.0;
    for (std::size_t i = 0; i < steps; ++i) {
      clock_.advance(milliseconds(1));
      for (auto& peer : peers_) {
        if (!peer) continue;
        peer->servo_step(clock_.now());
        peer->read_step(clock_.now());
        peer->model_step(clock_.now(), clock_.utc_now());
        peer->write_step();
      }
      if (!peers_[kSecond]) continue;
      peers_[kSecond]->views().update();
      felt = std::max(felt, peers_[kSecond]->views().read().servo().force.norm());
    }
    return felt;
  }
  /// From now on the thief's link, without a peer, receives what the others send.
  void eavesdrop() {
    const peer::GroupPool pool = peer::pool_of(scene_);
    static_cast<void>(network_.link(kThief).join(pool.base()));
    for (std::size_t i = 0; i < pool.size(); ++i)
      static_cast<void>(network_.link(kThief).join(pool.address(i)));
  }
  /// The thief's link sends the received states of the cube again, 3 m from their place and with
  /// later sequence numbers.  @return their number
  std::size_t forge() {
    std::size_t forged = 0;
    std::array<peer::Datagram, 64> datagrams;
    const std::size_t count = network_.link(kThief).receive(datagrams);
    for (const peer::Datagram& datagram : std::span(datagrams).first(count)) {
      std::vector<std::byte> octets(datagram.bytes.begin(), datagram.bytes.end());
      pdu::EntityState state;
      if (pdu::decode(octets, state) != pdu::DecodeError::none ||
          state.entity_id != peer::body_id(0))
        continue;
      state.location.x += 3.0;
      EXPECT_GT(pdu::encode(state, octets), 0u);
      octets[octets.size() - 10] ^= std::byte{1};  // of the sequence number
      forged += network_.link(kThief).send(datagram.group, octets) ? 1 : 0;
    }
    return forged;
  }
  [[nodiscard]] const peer::RemoteEntity* cube_row() {
    return peers_[kSecond]->model().remote().find(peer::body_id(0));
  }
  [[nodiscard]] double cube_at() { return peers_[kSecond]->bodies()->states()[0].position.x(); }
  std::vector<std::string> notices(std::size_t link) {
    std::vector<std::string> texts;
    while (const peer::Notice* notice = peers_[link]->notices().front()) {
      texts.emplace_back(notice->text.data());
      peers_[link]->notices().pop();
    }
    return texts;
  }
  [[nodiscard]] std::uint64_t count(std::string_view name) {
    const peer::Counter* found = peers_[kSecond]->counters().find(name);
    EXPECT_NE(found, nullptr) << name;
    return found == nullptr ? 0 : found->value();
  }

 private:
  peer::ManualClock clock_;
  peer::SimulatedNetwork network_;
  peer::SceneFile scene_;
  std::array<std::unique_ptr<haptics::SimulatedDevice>, kLinks> hands_;
  std::array<std::unique_ptr<peer::Peer>, kLinks> peers_;
  std::uint32_t lives_ = 0;
};

TEST(BodyOwner, IsTheFirstPeerOfTheScene) {
  Exercise exercise;
  exercise.start(kSecond, 2);
  exercise.start(kThief, 3);
  exercise.run(1000);
  EXPECT_EQ(exercise.run(2000), 0.0) << "the thief came first";
  EXPECT_EQ(exercise.cube_at(), 0.0);
  EXPECT_GT(exercise.count("bodies_disputed"), 0u);
  EXPECT_THAT(exercise.notices(kSecond),
              Contains(HasSubstr("a body of the scene comes only from its owner")));
  exercise.start(kFirst, 1);
  EXPECT_EQ(exercise.run(3000), 0.0);
  EXPECT_NEAR(exercise.cube_at(), 0.0, 1e-4);
}

TEST(BodyOwner, ForgedAddressMovesNothing) {
  Exercise exercise;
  exercise.eavesdrop();
  exercise.start(kSecond, 2);
  exercise.start(kFirst, 1);
  std::size_t forged = 0;
  for (int i = 0; i < 100; ++i) {
    exercise.run(20);
    forged += exercise.forge();
  }
  EXPECT_GT(forged, 0u);
  ASSERT_NE(exercise.cube_row(), nullptr);
  EXPECT_LT(exercise.cube_row()->state.position.norm(), 0.1);
  EXPECT_NEAR(exercise.cube_at(), 0.0, 1e-4);
  EXPECT_GE(exercise.count("datagrams_refused"), forged);
}

TEST(BodyOwner, RestartedOwnerTakesTheRow) {
  Exercise exercise;
  exercise.start(kSecond, 2);
  exercise.start(kFirst, 1);
  exercise.run(1000);
  ASSERT_NE(exercise.cube_row(), nullptr);
  const auto first_heard = exercise.cube_row()->first_heard;
  const std::uint32_t epoch = exercise.cube_row()->epoch;
  exercise.stop(kFirst);
  exercise.run(70'000);  // longer than any time-out
  ASSERT_NE(exercise.cube_row(), nullptr);
  EXPECT_NE(exercise.cube_row()->doubted_at, peer::RemoteEntity::kTrusted);
  exercise.start(kFirst, 1);
  exercise.run(1000);
  ASSERT_NE(exercise.cube_row(), nullptr);
  EXPECT_NE(exercise.cube_row()->epoch, epoch);
  EXPECT_EQ(exercise.cube_row()->first_heard, first_heard) << "the same row";
  EXPECT_EQ(exercise.cube_row()->doubted_at, peer::RemoteEntity::kTrusted);
}

TEST(BodyOwner, NobodyTakesTheSceneSite) {
  const peer::SceneFile scene = scene_of(with(kCube, "TOUCH", ""));
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
      static_cast<void>(scene_of(with(kCube, "TOUCH", std::string(key) + " = \"65534:1\"")));
      FAIL() << "accepted";
    } catch (const peer::SceneFileError& error) {
      EXPECT_THAT(error.what(), HasSubstr("site 65534, which belongs to the scene's bodies"));
    }
  }
}

TEST(BodyOwner, MayComeBackWhereAThiefIs) {
  for (const bool killed : {false, true}) {
    Exercise exercise;
    exercise.start(kFirst, 1);
    exercise.start(kSecond, 2);
    exercise.start(kThief, 3);
    exercise.run(2000);
    killed ? exercise.kill(kFirst) : exercise.stop(kFirst);
    EXPECT_EQ(exercise.run(8000), 0.0);
    exercise.start(kFirst, 1);
    EXPECT_EQ(exercise.run(6000), 0.0);
    EXPECT_NEAR(exercise.cube_at(), 0.0, 1e-4);
  }
}

TEST(BodyOwner, IsTheFirstOfTwoThatClaimIt) {
  Exercise exercise;
  exercise.start(kFirst, 1);
  exercise.start(kSecond, 2);
  exercise.run(1500);
  exercise.start(kThief, 1);
  EXPECT_EQ(exercise.run(4000), 0.0);
  EXPECT_GT(exercise.count("bodies_disputed"), 0u);
  for (const std::size_t link : {kFirst, kSecond, kThief})
    EXPECT_THAT(exercise.notices(link), Contains(HasSubstr("claims to be the scene's first peer")))
        << link;
}

TEST(BodyOwner, ComesNextWhenTheFirstClaimantLeaves) {
  Exercise exercise;
  exercise.start(kSecond, 2);
  exercise.start(kThief, 1);
  exercise.run(1500);
  EXPECT_NEAR(exercise.cube_at(), 0.1, 1e-3) << "without a key nobody can tell";
  exercise.start(kFirst, 1);
  exercise.run(2000);
  exercise.stop(kThief);
  exercise.run(1000);
  EXPECT_NEAR(exercise.cube_at(), 0.0, 1e-4);
}

TEST(BodyOwner, IsFeltOnlyIfTouchAdmitsIt) {
  Exercise exercise("touch = [\"1:2\"]");
  exercise.start(kSecond, 2);
  exercise.start(kThief, 1);
  EXPECT_EQ(exercise.run(3000), 0.0);
  EXPECT_EQ(exercise.cube_at(), 0.0);
  EXPECT_GT(exercise.count("touch_refused"), 0u);
}

TEST(BodyOwner, IsNamedInAnInteropExercise) {
  Exercise open("interop = true");
  open.start(kSecond, 2);
  open.start(kThief, 1);
  EXPECT_EQ(open.run(3000), 0.0);
  Exercise named("interop = true\ntouch = [\"1:3\"]");
  named.start(kSecond, 2);
  named.start(kThief, 1);
  named.run(1000);
  EXPECT_NEAR(named.cube_at(), 0.1, 1e-3);
}

}  // namespace
}  // namespace reckon::test
