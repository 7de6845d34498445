// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/servo/servo_loop.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <random>
#include <stdexcept>
#include <thread>

#include "reckon/tests/haptics/support/servo_bench.hpp"

namespace reckon::haptics::servo_loop_test {
namespace {

using namespace bench;

TEST(ServoLoop, HoldsAHandAgainstAWall) {
  Bench bench(floor(800), at(0.03), presses(0.01));
  const ServoSnapshot& s = bench.run(4s);
  EXPECT_TRUE(s.in_mesh_contact);
  // Springs in series: 200 N/m hand, 10 mm below the surface, 800 N/m wall.
  EXPECT_NEAR(s.force.z(), 0.01 / (1 / 200.0 + 1 / 800.0), 1e-6);
  EXPECT_NEAR(s.scp.z(), 0.0, 1e-7);
  EXPECT_GE(bench.least, kPassive);
  EXPECT_GE(s.port_energy_min, kPassive);
}

TEST(ServoLoop, SoftensTooStiffAWallAndStaysPassive) {
  Bench bench(floor(5000, 0.3), at(0.03), presses(0.01));
  const ServoSnapshot& s = bench.run(4s);
  EXPECT_LT(bench.servo.static_stiffness_limit(), 2000.0);
  EXPECT_GE(bench.least, kPassive);
  EXPECT_LT(s.device_velocity.norm(), 1e-4);
  EXPECT_GT(s.force.z(), 1.0);
}

TEST(ServoLoop, RampsUpWhenItStartsInsideAnObject) {
  Bench bench(floor(800), at(-0.01), presses(0.01, -0.01));
  EXPECT_EQ(bench.run(1ms).force.norm(), 0.0);
  double last = 0, step = 0;
  for (int i = 0; i < 3000; ++i) {
    const double force = bench.run(1ms).force.norm();
    step = std::max(step, std::abs(force - last));
    last = force;
  }
  EXPECT_LT(step, 0.2);
  EXPECT_GE(bench.least, kPassive);
}

TEST(ServoLoop, RendersARemoteHandAsReceivedOnceSettled) {
  SimulatedDeviceConfig config = at(0.06);
  ServoConfig servo;
  Bench bench({}, config, presses(-0.025, 0.06), servo);
  bench.servo.contacts().write(only(sphere(Vector3d::Zero(), 600)));
  const ServoSnapshot& s = bench.run(6s);
  ASSERT_EQ(s.count, 1u);
  const double depth = 0.03 - bench.device.position().z();
  EXPECT_NEAR(s.force.z(), 600 * depth, 1e-9);
  EXPECT_GT(depth, 0.001);
  EXPECT_LE((s.contacts[0].force - s.contacts[0].ungated_force).norm(), 1e-9);
  EXPECT_GE(bench.least, kPassive);
}

TEST(ServoLoop, PredictsTheMotionOfARemoteHand) {
  Bench bench({}, at(0.0));
  RemoteHand hand = sphere({0, 0, -0.2}, 300);
  hand.state.velocity = {0, 0, 0.05};
  bench.servo.contacts().write(only(hand));
  bench.run(500ms);
  const double reach = 0.03, centre = -0.2 + 0.05 * 0.499;
  EXPECT_NEAR(bench.servo.snapshots().read().contacts[0].depth,
              reach - (bench.device.position().z() - centre), 1e-9);
}

TEST(ServoLoop, FadesOutAnExpiredModel) {
  Bench bench({}, at(0.06), presses(-0.025, 0.06));
  RemoteHand hand = sphere(Vector3d::Zero(), 600);
  hand.valid_until = 4s;
  bench.servo.contacts().write(only(hand));
  const double full = bench.run(4s).force.norm();
  EXPECT_GT(full, 0.5);
  const double half = bench.run(50ms).force.norm();
  EXPECT_GT(half, 0.1);
  EXPECT_EQ(bench.run(60ms).force.norm(), 0.0);
  EXPECT_GE(bench.least, kPassive);
}

TEST(ServoLoop, FadesOutLeavingHandsAndFreesSlots) {
  Bench bench({}, at(0.06), presses(-0.025, 0.06));
  bench.servo.contacts().write(only(sphere(Vector3d::Zero(), 600)));
  EXPECT_GT(bench.run(4s).force.norm(), 0.5);
  bench.servo.contacts().write(ContactSet{});
  EXPECT_GT(bench.run(20ms).force.norm(), 0.1);
  const ServoSnapshot& s = bench.run(200ms);
  EXPECT_EQ(s.force.norm(), 0.0);
  EXPECT_EQ(s.count, 0u);
}

TEST(ServoLoop, FrozenHoldsTheSurfaceInPlace) {
  Bench bench({}, at(0.0));
  RemoteHand hand = sphere({0, 0, -0.2}, 300);
  hand.state.velocity = {0, 0, 0.05};
  bench.servo.contacts().write(only(hand));
  const double before = bench.run(1s).contacts[0].depth;
  ContactSet frozen = only(hand);
  frozen.frozen = true;
  bench.servo.contacts().write(frozen);
  EXPECT_NEAR(bench.run(2s).contacts[0].depth, before, 1e-3);
}

TEST(ServoLoop, SwitchCutsAtOnceAndTheForceReturns) {
  Bench bench(floor(800), at(0.03), [](double t) {
    HandTarget hand;  // in, out from 7 s on, in again
    hand.position.z() = t < 7 || t > 8 ? std::max(-0.01, 0.03 - 0.05 * t) : 0.01;
    return hand;
  });
  const double full = bench.run(4s).force.norm();
  bench.device.enable(false);
  EXPECT_EQ(bench.run(1ms).force.norm(), 0.0);
  bench.run(200ms);
  bench.device.enable(true);
  EXPECT_LT(bench.run(1ms).force.norm(), 0.1 * full);
  EXPECT_GT(bench.run(1s).force.norm(), 0.1 * full);
  // The wall is complete again only after the hand was outside: pushing it out was not paid for.
  EXPECT_NEAR(bench.run(6s).force.norm(), full, 1e-3);
  EXPECT_GE(bench.least, kPassive);
}

TEST(ServoLoop, SurvivesUnpluggingAndCountsIt) {
  Bench bench(floor(800), at(0.03), presses(0.01));
  bench.run(2s);
  bench.device.plug(false);
  EXPECT_EQ(bench.run(300ms).force.norm(), 0.0);
  EXPECT_EQ(bench.servo.snapshots().read().trips, 1u);
  bench.device.plug(true);
  bench.run(4s);
  EXPECT_GT(bench.servo.snapshots().read().force.norm(), 0.2);
  EXPECT_GE(bench.least, kPassive);
}

TEST(ServoLoop, TripsOnARunawayHand) {
  SimulatedDeviceConfig config = at(0.03);
  config.max_speed = 0.5;
  Bench bench(floor(800), config, [](double t) {
    HandTarget hand;
    hand.position.z() = 0.03;
    if (t > 1) hand.push.x() = 20;
    return hand;
  });
  bench.run(2s);
  EXPECT_GE(bench.servo.snapshots().read().trips, 1u);
}

TEST(ServoLoop, StaysPassiveWhenItsThreadIsLate) {
  std::mt19937 rng(4);
  Bench bench(floor(900), at(0.03), presses(0.01));
  bench.servo.contacts().write(only(sphere({0, 0, -0.022}, 500)));
  for (int i = 0; i < 3000; ++i) {
    bench.run(1ms);
    if (rng() % 40 == 0) bench.now += nanoseconds(1000000 * (rng() % 7));
  }
  std::printf("late servo: least energy %.2g J\n", bench.least);
  EXPECT_GE(bench.least, kPassive);
}

TEST(ServoLoop, ContinuesAfterAStallWithAReleasedForce) {
  Bench bench(floor(800), at(0.03), presses(0.01));
  const double held = bench.run(4s).force.z();
  bench.now += 36ms;  // beyond the device's 10 ms watchdog
  const ServoSnapshot& back = bench.run(200ms);
  EXPECT_EQ(back.trips, 0u);
  // Without support the hand fell some millimetres deeper: the full force would take energy that no
  // one put in.
  EXPECT_GE(back.force.z(), 0.4 * held);
  EXPECT_GE(bench.least, kPassive);
  EXPECT_GE(back.port_energy_min, kPassive);
}

TEST(ServoLoop, RespectsTheDevicesLimitInEverySituation) {
  SimulatedDeviceConfig config = at(0.03);
  config.max_force = 2;
  Bench bench(floor(900), config, presses(0.04));
  bench.servo.contacts().write(only(sphere({0, 0, -0.03}, 800)));
  bench.run(5s);
  EXPECT_LE(bench.peak, 2 + 1e-12);
  EXPECT_GT(bench.peak, 1.5);
  EXPECT_GE(bench.least, kPassive);
}

HandScript along(double from, double begin, double speed) {
  return [=](double t) {
    HandTarget hand;
    hand.position.z() = from + speed * std::max(0.0, t - begin);
    return hand;
  };
}

// The hand moves down at 20 cm/s towards a floor 1 m below it.
TEST(ServoLoop, IsNearASurfaceBeforeContact) {
  Bench bench(floor(800), at(1.0), along(1.0, 0.0, -0.2));
  bench.run(10ms);
  EXPECT_FALSE(bench.servo.has_near());
  while (!bench.servo.has_near()) ASSERT_GT(bench.run(1ms).device.z(), 0.15);
  EXPECT_NEAR(bench.device.position().z(), ServoLoop::kSoonFelt, 0.01);
  while (!(bench.run(1ms).force.norm() > 0)) EXPECT_TRUE(bench.servo.has_near());
}

TEST(ServoLoop, IsNearAListedRemoteHand) {
  Bench bench({}, at(0.1));
  bench.run(10ms);
  EXPECT_FALSE(bench.servo.has_near());
  bench.servo.contacts().write(only(sphere({0, 0, 0.2}, 300)));
  bench.run(1ms);
  EXPECT_TRUE(bench.servo.has_near());
  bench.servo.contacts().write({});
  bench.run(1s);
  EXPECT_FALSE(bench.servo.has_near());
}

TEST(ServoLoop, HasTenfoldNewsOfAMovingHand) {
  Bench bench({}, at(0.0), along(0.0, 1.0, 0.2));
  const auto news_of = [&](int steps) {
    int news = 0;
    for (int i = 0; i < steps; ++i) {
      bench.run(1ms);
      news += bench.servo.take_news(1e-4) ? 1 : 0;
    }
    return news;
  };
  news_of(500);
  EXPECT_EQ(news_of(400), 40);
  news_of(300);
  EXPECT_EQ(news_of(400), 400);
}

TEST(ServoLoop, TracesEveryStepUntilTheRingIsFull) {
  TraceRing ring(128);
  Bench bench;
  bench.servo.trace(&ring);
  bench.run(158ms);
  ServoSnapshot record;
  std::uint64_t expected = 0;
  while (ring.pop(record)) EXPECT_EQ(record.step, expected++);
  EXPECT_EQ(expected, 128u);
  EXPECT_EQ(ring.refused(), 30u);
}

TEST(ServoLoop, RefusesSettingsOutOfRangeByName) {
  SimulatedDevice device(SimulatedDeviceConfig{});
  ServoConfig config;
  config.period = 50us;
  EXPECT_THROW(ServoLoop(device, EffectPlan(), config), std::invalid_argument);
  config = {};
  config.stiffness_share = 1.5;
  EXPECT_THROW(ServoLoop(device, EffectPlan(), config), std::invalid_argument);
}

TEST(ServoLoop, RunsConcurrentlyWithAModelThread) {
  Bench bench(floor(800), at(0.03), presses(0.01));
  std::atomic<bool> stop = false;
  std::thread model([&] {
    std::uint32_t version = 0;
    std::uint64_t last = 0;
    while (!stop) {
      bench.servo.contacts().write(only(sphere({0, 0, -0.022}, 300, ++version)));
      if (bench.servo.snapshots().update()) {
        const std::uint64_t step = bench.servo.snapshots().read().step;
        EXPECT_GE(step, last);
        last = step;
      }
    }
  });
  for (nanoseconds now{0}; now < 1s; now += 1ms) bench.servo.step(now);
  stop = true;
  model.join();
}

}  // namespace
}  // namespace reckon::haptics::servo_loop_test
