// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A first peer without a device moves the bodies of its scene, and other peers see and feel them.
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <memory>
#include <span>
#include <string_view>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/peer/network/simulated_network.hpp"
#include "reckon/peer/peer.hpp"
#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/in_process.hpp"

namespace reckon::test {
namespace {

constexpr std::string_view kFallingCube = R"(
[[object]]
name = "floor"
plane = [0, 0, 1]
surface = {stiffness = "400 N/m"}

[[object]]
name = "cube"
box = "40 40 40 mm"
position = "0 0 300 mm"
mass = "50 g"
restitution = 0.3
surface = {stiffness = "400 N/m"}

[[operator]]
passive = true

[[device]]
peer = 1
operator = 1

[[device]]
peer = 2
operator = 1
)";

/// A first peer without a device, a second with a hand below the cube, and a third without one.
class Handless {
 public:
  Handless() : clock_(seconds(1), std::chrono::hours(1)), network_({.links = 3}, clock_) {
    haptics::SimulatedDeviceConfig config;
    config.hand_stiffness = 300;
    config.start = {0.15, 0, 0.01};
    hand_ = std::make_unique<haptics::SimulatedDevice>(config, [](double t) {
      return haptics::HandTarget{{t < 2.0 ? 0.15 : 0.0, 0, 0.01}};
    });
    for (std::size_t i = 0; i < 3; ++i) {
      peer::PeerOptions own;
      own.application = static_cast<std::uint16_t>(i + 1);
      own.epoch = static_cast<std::uint32_t>(i + 1);
      own.scene_peer = static_cast<std::uint8_t>(i + 1);
      peer::PeerDevice device;
      device.device = hand_.get();
      peers_[i] = std::make_unique<peer::Peer>(scene_, own, network_.link(i),
                                               std::span(&device, i == 1 ? 1u : 0u));
      peers_[i]->start(clock_.now());
    }
  }
  void step() {
    clock_.advance(milliseconds(1));
    for (auto& peer : peers_) {
      peer->servo_step(clock_.now());
      peer->read_step(clock_.now());
      peer->model_step(clock_.now(), clock_.utc_now());
      peer->write_step();
    }
  }
  void run(int steps) {
    for (int i = 0; i < steps; ++i) step();
  }
  [[nodiscard]] const haptics::BodyState& cube(std::size_t peer) {
    return peers_[peer]->bodies()->states()[0];
  }
  [[nodiscard]] peer::Peer& peer(std::size_t i) { return *peers_[i]; }
  [[nodiscard]] nanoseconds now() const { return clock_.now(); }
  [[nodiscard]] double felt() {
    peers_[1]->views().update();
    return peers_[1]->views().read().servo().force.norm();
  }

 private:
  peer::ManualClock clock_;
  peer::SimulatedNetwork network_;
  peer::SceneFile scene_ = scene_of(kFallingCube);
  std::unique_ptr<haptics::SimulatedDevice> hand_;
  std::array<std::unique_ptr<peer::Peer>, 3> peers_;
};

TEST(HandlessPeer, MovesTheBodiesOfItsScene) {
  Handless exercise;
  EXPECT_EQ(exercise.cube(0).position.z(), 0.3);
  exercise.run(100);
  EXPECT_EQ(exercise.peer(0).next_step(), exercise.now() + milliseconds(1));
  exercise.run(1900);
  EXPECT_NEAR(exercise.cube(0).position.z(), 0.02, 1e-4) << "it fell";
  EXPECT_FALSE(exercise.cube(0).carried);
  EXPECT_LT((exercise.cube(1).position - exercise.cube(0).position).norm(), 1e-4);
  EXPECT_TRUE(exercise.cube(1).carried);
  EXPECT_TRUE(exercise.cube(2).carried);
  exercise.run(1500);
  int soon = 0;
  for (int i = 0; i < 100; ++i) {
    exercise.step();
    soon += exercise.peer(0).next_step() <= exercise.now() + milliseconds(1) ? 1 : 0;
  }
  EXPECT_LT(soon, 10) << "it sleeps";
  EXPECT_GT(exercise.felt(), 0.3) << "the hand of the second peer came to it";
}

TEST(HandlessPeer, CostsNoAllocation) {
  Handless exercise;
  exercise.run(1000);
  const AllocationGuard guard;
  exercise.run(1000);
  EXPECT_EQ(guard.count(), 0u);
}

// The second peer takes the cube over as the first one left it.
TEST(HandlessPeer, HandsABodyOver) {
  Handless exercise;
  exercise.run(150);
  haptics::BodyOrder order{haptics::BodyAct::disown, 0};
  ASSERT_NE(exercise.peer(0).bodies()->exchange().send(std::span(&order, 1)), 0u);
  exercise.step();
  haptics::BodyEnd end;
  ASSERT_TRUE(exercise.peer(0).bodies()->exchange().take_end(end));
  order = {haptics::BodyAct::own, 0, end.state};
  ASSERT_NE(exercise.peer(1).bodies()->exchange().send(std::span(&order, 1)), 0u);
  const double height = exercise.cube(0).position.z();
  exercise.run(50);
  EXPECT_TRUE(exercise.cube(0).carried);
  EXPECT_EQ(exercise.cube(0).position.z(), height) << "it stands until the new owner states it";
  EXPECT_FALSE(exercise.cube(1).carried);
  EXPECT_LT(exercise.cube(1).position.z(), height - 0.01);
  order.act = haptics::BodyAct::disown;
  ASSERT_NE(exercise.peer(1).bodies()->exchange().send(std::span(&order, 1)), 0u);
  exercise.run(20);
  ASSERT_TRUE(exercise.peer(1).bodies()->exchange().take_end(end));
  EXPECT_LT((exercise.cube(1).position - end.state.position).norm(), 1e-15) << "not an older state";
}

}  // namespace
}  // namespace reckon::test
