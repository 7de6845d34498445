// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A cube that the first peer's hand pushes, shown and felt at another peer.
#include "reckon/peer/world/shared_bodies.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <string>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/peer/network/simulated_network.hpp"
#include "reckon/peer/peer.hpp"
#include "reckon/tests/integration/owners_exercise.hpp"
#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/in_process.hpp"

namespace reckon::test {
namespace {

using Eigen::Vector3d;

haptics::HandTarget at(double x, double height) {
  haptics::HandTarget target;
  target.position = {x, 0, height};
  return target;
}

/// The first hand pushes the cube back and forth until 4 s, then releases it. The second one waits
/// at `second`.
class Table {
 public:
  Table(const peer::ImpairmentLaw& law, const Vector3d& second)
      : clock_(seconds(1), std::chrono::hours(1)),
        network_({}, clock_),
        scene_(scene_of(cubes_scene(1))) {
    network_.impair(law);
    const auto push = [](double t) {
      const double slow = std::min(t, 4.0);
      return at(
          -0.06 + 0.05 * (1 - std::cos(1.5 * slow)) - (t > 4 ? 0.1 : 0.0) * std::min(1.0, t - 4),
          0.015);
    };
    const auto wait = [second](double) { return at(second.x(), second.z()); };
    haptics::SimulatedDeviceConfig config;
    config.hand_stiffness = 300;
    config.start = push(0).position;
    hands_[0] = std::make_unique<haptics::SimulatedDevice>(config, push);
    config.start = second;
    hands_[1] = std::make_unique<haptics::SimulatedDevice>(config, wait);
    for (std::size_t i = 0; i < 2; ++i) {
      peer::PeerOptions own;
      own.application = static_cast<std::uint16_t>(i + 1);
      own.epoch = static_cast<std::uint32_t>(i + 1);
      own.scene_peer = static_cast<std::uint8_t>(i + 1);
      peers_[i] = std::make_unique<peer::Peer>(scene_, own, network_.link(i), *hands_[i]);
      peers_[i]->start(clock_.now());
    }
  }
  void step() {
    clock_.advance(milliseconds(1));
    const nanoseconds now = clock_.now();
    for (auto& peer : peers_) {
      if (!peer) continue;
      peer->servo_step(now);
      peer->read_step(now);
      peer->model_step(now, clock_.utc_now());
      peer->write_step();
    }
  }
  /// Has another epoch after a restart.
  void first_returns() {
    peer::PeerOptions own;
    own.epoch = 3;
    own.scene_peer = 1;
    peers_[0] = std::make_unique<peer::Peer>(scene_, own, network_.link(0), *hands_[0]);
    peers_[0]->start(clock_.now());
  }
  void first_leaves() {
    peers_[0]->stop(clock_.now(), clock_.utc_now());
    peers_[0].reset();
  }
  [[nodiscard]] const haptics::BodyState& cube(std::size_t peer) const {
    return peers_[peer]->bodies()->states()[0];
  }
  [[nodiscard]] std::span<const peer::RemoteEntity> rows(std::size_t peer) const {
    return peers_[peer]->model().remote().rows();
  }
  [[nodiscard]] double apart() const { return (cube(0).position - cube(1).position).norm(); }
  [[nodiscard]] const haptics::SimulatedDevice& hand(std::size_t peer) const {
    return *hands_[peer];
  }
  [[nodiscard]] const haptics::ServoSnapshot& feels(std::size_t peer) {
    peers_[peer]->views().update();
    return peers_[peer]->views().read().servo();
  }

 private:
  peer::ManualClock clock_;
  peer::SimulatedNetwork network_;
  peer::SceneFile scene_;
  std::array<std::unique_ptr<haptics::SimulatedDevice>, 2> hands_;
  std::array<std::unique_ptr<peer::Peer>, 2> peers_;
};

TEST(SharedBody, IsWhereItsOwnerHasIt) {
  for (const auto& law :
       {line_of(nanoseconds(100'000), {}, 0.0), line_of(milliseconds(20), {}, 0.0),
        line_of(milliseconds(50), milliseconds(20), 0.3)}) {
    Table table(law, {0.3, 0, 0.2});
    double moved = 0.0, apart = 0.0;
    for (int i = 0; i < 7000; ++i) {
      table.step();
      moved = std::max(moved, table.cube(0).position.x());
      if (i > 500) apart = std::max(apart, table.apart());
    }
    EXPECT_GT(moved, 0.03);
    // At some 0.08 m/s and friction of 4 m/s^2: the threshold, and the motion during the delay.
    const double delay = pdu::to_seconds(law.delay + law.jitter);
    EXPECT_LT(apart, 0.002 + 0.15 * delay + 0.5 * 4 * delay * delay + (law.loss > 0 ? 0.01 : 0.0));
    EXPECT_LT(table.apart(), 1e-4) << "at rest";
  }
}

// The cube is pushed against a hand of the other peer: it does not yield, and gives no more energy
// than the port may receive.
TEST(SharedBody, IsFeltByAHandInItsWay) {
  Table table(line_of(milliseconds(5), {}, 0.0), {0.05, 0, 0.02});
  double felt = 0.0;
  for (int i = 0; i < 6000; ++i) {
    table.step();
    const haptics::ServoSnapshot& step = table.feels(1);
    felt = std::max(felt, step.force.x());
    ASSERT_GE(step.port_energy_min, -1e-9);
    ASSERT_LE(-table.hand(1).port_work() - table.hand(1).damping_loss(),
              0.008 + 0.2 * 1e-3 * i + 1e-9);
  }
  EXPECT_GT(felt, 0.5);
}

TEST(SharedBody, StaysWhereItWasWhenItsOwnerLeaves) {
  Table table(line_of(milliseconds(5), {}, 0.0), {0.3, 0, 0.2});
  for (int i = 0; i < 1500; ++i) table.step();
  ASSERT_GT(table.cube(1).position.x(), 0.01);
  table.first_leaves();
  for (int i = 0; i < 1000; ++i) table.step();  // it comes to rest
  const Vector3d left = table.cube(1).position;
  for (int i = 0; i < 2000; ++i) table.step();
  EXPECT_LT((table.cube(1).position - left).norm(), 1e-12);
  EXPECT_GT(left.x(), 0.01) << "it went back to where the scene has it";
  EXPECT_TRUE(table.cube(1).velocity.isZero());
}

TEST(SharedBody, HasAnIdOfTheScene) {
  Table table(line_of(milliseconds(5), {}, 0.0), {0.3, 0, 0.2});
  for (int i = 0; i < 1500; ++i) table.step();
  const std::span<const peer::RemoteEntity> rows = table.rows(1);
  ASSERT_EQ(rows.size(), 2u) << "hand and cube";
  const auto cube = std::ranges::find(rows, peer::body_id(0), &peer::RemoteEntity::id);
  ASSERT_NE(cube, rows.end());
  EXPECT_EQ(cube->id, (pdu::EntityId{65534, 1, 1}));
  EXPECT_EQ(cube->type, peer::body_type(0));
  EXPECT_EQ(cube->epoch, 1u);
}

TEST(SharedBody, NextOwnerMovesItWithoutAJump) {
  Table table(line_of(milliseconds(5), {}, 0.0), {0.3, 0, 0.2});
  for (int i = 0; i < 1500; ++i) table.step();
  table.first_leaves();
  for (int i = 0; i < 1000; ++i) table.step();
  const double left = table.cube(1).position.x();
  ASSERT_GT(left, 0.01);
  table.first_returns();  // there the cube is where the scene has it
  double jump = 0.0;
  // The second peer waits 3 s for a majority of the old owners.
  for (int i = 0; i < 6000; ++i) {
    const Vector3d before = table.cube(1).position;
    table.step();
    jump = std::max(jump, (table.cube(1).position - before).norm());
  }
  EXPECT_LE(jump, 1e-3);
  EXPECT_GT(jump, 0.0);
  EXPECT_LT(table.apart(), 0.003);
}

TEST(SharedBody, CostsNoAllocation) {
  Table table(line_of(milliseconds(5), {}, 0.1), {0.05, 0, 0.02});
  for (int i = 0; i < 3500; ++i) table.step();  // until both peers have owned it
  const AllocationGuard guard;
  for (int i = 0; i < 3000; ++i) table.step();
  EXPECT_EQ(guard.count(), 0u);
}

}  // namespace
}  // namespace reckon::test
