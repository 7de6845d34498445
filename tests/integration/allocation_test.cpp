// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "reckon/pdu/warfare/fire.hpp"
#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/in_process.hpp"

namespace reckon::test {
namespace {

// Heap allocations of each loop, counted around every single step.
struct LoopAllocations {
  std::size_t servo = 0, read = 0, model = 0, write = 0;
};

class Loops {
 public:
  Loops(const peer::SceneFile& scene, const peer::ImpairmentLaw& law)
      : clock_(seconds(1), std::chrono::hours(1)), network_({}, clock_) {
    network_.impair(law);
    for (std::size_t i = 0; i < 2; ++i) {
      peer::PeerOptions own;
      own.application = static_cast<std::uint16_t>(i + 1);
      own.epoch = static_cast<std::uint32_t>(i + 1);
      hands_[i] = tools::make_simulated_hand(scene, i);
      peers_[i] = std::make_unique<peer::Peer>(scene, own, network_.link(i), *hands_[i]);
      peers_[i]->start(clock_.now());
    }
  }

  LoopAllocations run(std::size_t count) {
    LoopAllocations sum;
    const auto counted = [](std::size_t& into, auto&& step) {
      const AllocationGuard guard;
      step();
      into += guard.count();
    };
    for (std::size_t i = 0; i < count; ++i) {
      clock_.advance(milliseconds(1));
      const nanoseconds now = clock_.now();
      for (auto& peer : peers_) {
        counted(sum.servo, [&] { peer->servo_step(now); });
        counted(sum.read, [&] { peer->read_step(now); });
        if (step_ % 2 == 0) counted(sum.model, [&] { peer->model_step(now, clock_.utc_now()); });
        counted(sum.write, [&] { peer->write_step(); });
        touching_ += touches(*peer);
      }
      ++step_;
    }
    return sum;
  }
  [[nodiscard]] std::size_t touching() const { return touching_; }
  [[nodiscard]] peer::Peer& peer(std::size_t index) { return *peers_[index]; }

 private:
  static std::size_t touches(peer::Peer& peer) {
    peer.views().update();
    const haptics::ServoSnapshot& servo = peer.views().read().servo();
    return servo.count > 0 && servo.contacts[0].force.norm() > 0.0 ? 1 : 0;
  }

  peer::ManualClock clock_;
  peer::SimulatedNetwork network_;
  std::array<std::unique_ptr<haptics::SimulatedDevice>, 2> hands_;
  std::array<std::unique_ptr<peer::Peer>, 2> peers_;
  std::size_t step_ = 0;
  std::size_t touching_ = 0;
};

void expect_none(const LoopAllocations& sum) {
  EXPECT_EQ(sum.servo, 0u);
  EXPECT_EQ(sum.read, 0u);
  EXPECT_EQ(sum.model, 0u);
  EXPECT_EQ(sum.write, 0u);
}

TEST(Loops, AllocateNothingPerStepWhileTwoHandsTouch) {
  const peer::SceneFile scene = scene_of(kTwoHandsOnAWall);
  Loops loops(scene, {});
  loops.run(500);
  expect_none(loops.run(20'000));
  EXPECT_GT(loops.touching(), 1000u);
  EXPECT_GT(loops.peer(0).counters().find("updates_in")->value(), 10u);
}

TEST(Loops, AllocateNothingForAssuredMessages) {
  peer::ImpairmentLaw law;
  law.delay = milliseconds(1);
  law.loss = 0.3;
  Loops loops(scene_of(kTwoHandsOnAWall), law);
  static_cast<void>(loops.run(2000));
  const std::vector<std::byte> fire = [] {
    std::vector<std::byte> octets(96);
    pdu::Fire message;
    message.header.exercise_id = 1;
    EXPECT_EQ(pdu::encode(message, octets), octets.size());
    return octets;
  }();
  std::size_t model = 0;
  for (std::uint64_t tag = 1; tag <= 300; ++tag) {
    peer::ModelLoop& loop = loops.peer(tag % 2).model();
    const AllocationGuard guard;
    loop.assured().send(fire, tag, 0, loop.pass());
    model += guard.count();
    const LoopAllocations sum = loops.run(10);
    model += sum.read + sum.model + sum.write;
  }
  EXPECT_EQ(model, 0U);
  EXPECT_GT(loops.peer(0).counters().find("assured_in")->value(), 140U);
}

TEST(Loops, AllocateNothingOnAMeshWithFriction) {
  const peer::SceneFile scene = shipped_scene();
  Loops loops(scene, {});
  loops.run(500);
  expect_none(loops.run(20'000));
}

TEST(Loops, AllocateNothingOnLossyNetworksWithReturningPeers) {
  const peer::SceneFile scene = scene_of(kTwoHandsOnAWall);
  peer::ImpairmentLaw law;
  law.delay = milliseconds(50);
  law.jitter = milliseconds(40);
  law.loss = 0.2;
  law.reorder = law.duplicate = 0.1;
  law.outages = {{seconds(5), seconds(8), seconds(14)}};
  Loops loops(scene, law);
  loops.run(500);
  expect_none(loops.run(30'000));
  EXPECT_GT(loops.peer(0).counters().find("timed_out")->value(), 0u);
}

}  // namespace
}  // namespace reckon::test
