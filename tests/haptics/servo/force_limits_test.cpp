// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The force on a hand grows and turns at most at the servo's rate, falls at any rate, pushes a
// yielding hand at most with the power limit, and the difference is booked.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <stdexcept>

#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/haptics/passivity/rate_limit.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"

namespace reckon::haptics::force_limits_test {
namespace {

using Eigen::Vector3d;
using std::chrono::nanoseconds;
using namespace std::chrono_literals;

SceneObject object(const Shape& shape, const Vector3d& at, double stiffness) {
  SceneObject out;
  out.name = "object";
  out.shape = shape;
  out.pose.position = at;
  out.effects.of<SpringDamper>() = {stiffness, 0.0};
  return out;
}

class Bench {
 public:
  Bench(const Scene& scene, const Vector3d& start, HandScript script, ServoConfig config = {})
      : device_(config_at(start), std::move(script)), servo(device_, EffectPlan(scene), config) {}

  void run(nanoseconds duration) {
    for (const nanoseconds end = now_ + duration; now_ < end; now_ += 1ms) {
      const Vector3d before = device_.force();
      servo.step(now_);
      servo.snapshots().update();
      const Vector3d after = device_.force();
      const Vector3d at = servo.snapshots().read().device;
      if (now_ > 0ms) power = std::max(power, before.dot(at - at_) / 1e-3);
      at_ = at;
      // 1e-9 N for rounding.
      if (!within_reach(before, after, 1e-3 * servo.force_rate_limit() + 1e-9)) ++too_fast;
      const ServoSnapshot& s = servo.snapshots().read();
      double moved = 0;
      for (std::size_t i = 0; i < s.count; ++i)
        moved += s.contacts[i].received - s.contacts[i].given;
      least = std::min(
          least, device_.port_work() + device_.damping_loss() + moved + s.loan + s.source_energy());
      peak = std::max(peak, after.norm());
    }
  }
  [[nodiscard]] const ServoSnapshot& snapshot() { return servo.snapshots().read(); }

 private:
  static SimulatedDeviceConfig config_at(const Vector3d& start) {
    SimulatedDeviceConfig config;
    config.start = start;
    return config;
  }
  SimulatedDevice device_;
  nanoseconds now_{0};
  Vector3d at_ = Vector3d::Zero();

 public:
  ServoLoop servo;
  int too_fast = 0;
  double least = 0, peak = 0, power = 0;
};

Scene floor(double stiffness) {
  Scene scene;
  scene.objects.push_back(object(PlaneShape{}, Vector3d::Zero(), stiffness));
  return scene;
}

TEST(ForceRate, SlowContactWithAWallIsNotLimited) {
  // A hand that is thrown: the grip is far ahead of it.
  Bench bench(floor(1425), {0, 0, 0.05}, [](double t) {
    HandTarget hand;
    hand.position.z() = 0.05 - 0.85 * std::min(t, 0.09);
    return hand;
  });
  bench.run(300ms);
  EXPECT_GT(bench.peak, 5.0);
  EXPECT_EQ(bench.snapshot().tally.rate.seconds, 0.0);
  EXPECT_EQ(bench.too_fast, 0);
  EXPECT_GE(bench.least, -1e-9);
}

TEST(ForceRate, LagIsBookedAndReported) {
  ServoConfig slow;
  slow.max_force_rate = 300;
  Bench bench(
      floor(1425), {0, 0, 0.05},
      [](double t) {
        HandTarget hand;
        hand.position = {0.1 * std::min(t, 0.3), 0, std::max(-0.02, 0.05 - 0.6 * t)};
        return hand;
      },
      slow);
  EXPECT_EQ(bench.servo.force_rate_limit(), 300);
  bench.run(1s);
  EXPECT_EQ(bench.too_fast, 0);
  EXPECT_GE(bench.least, -1e-9);
  const Shortfall& told = bench.snapshot().tally.rate;
  EXPECT_GT(told.seconds, 0.0);
  EXPECT_LT(told.share, 0.9);
  // Springs in series with the grip, once it has come to rest.
  const double right = 0.02 / (1 / 1425.0 + 1 / SimulatedDeviceConfig().hand_stiffness);
  EXPECT_NEAR(bench.snapshot().force.z(), right, 1e-3 * right);
}

// Pressed for a long time, released, pressed again: the part that the limit removes from the wall
// is booked.
TEST(ForceHeat, WarmMotorsHoldTheirForceWithoutMakingEnergy) {
  ServoConfig warm;
  warm.continuous_force = 2.0;
  warm.thermal_time = 10.0;
  Bench bench(
      floor(1425), {0, 0, 0.02},
      [](double t) {
        HandTarget hand;
        const bool away = t > 4 && t < 34;
        hand.position = {0.01 * std::sin(3 * t), 0, away ? 0.02 : std::max(-0.03, 0.02 - 0.5 * t)};
        return hand;
      },
      warm);
  bench.run(4s);
  EXPECT_GT(bench.peak, 7.0) << "while they were cold";
  EXPECT_NEAR(bench.snapshot().force.z(), 2.0, 1e-3);
  EXPECT_LT(bench.snapshot().limit_share, 0.1) << "of what the wall asks that far inside";
  EXPECT_GT(bench.snapshot().tally.limit.seconds, 2.0);
  bench.run(30s);
  EXPECT_EQ(bench.snapshot().force.z(), 0.0);
  bench.peak = 0;
  bench.run(300ms);
  EXPECT_GT(bench.peak, 7.0) << "they are cold again";
  EXPECT_GE(bench.least, -1e-9);
  EXPECT_EQ(bench.too_fast, 0);
  EXPECT_EQ(bench.snapshot().trips, 0U);
}

// Pressed into a wall, then pulled off it at up to 1.2 m/s: the wall pushes in the same direction.
HandTarget pulled_off(double t) {
  HandTarget hand;
  hand.position.z() =
      t < 0.5 ? 0.02 - 0.06 * t / 0.5 : -0.04 + 6.0 * std::pow(std::min(t, 0.6) - 0.5, 2);
  return hand;
}

TEST(ForcePower, IsCutForAQuicklyYieldingHand) {
  Bench free(floor(1425), {0, 0, 0.02}, pulled_off);
  free.run(1s);
  ServoConfig weak;
  weak.max_power = 0.1;
  Bench bench(floor(1425), {0, 0, 0.02}, pulled_off, weak);
  EXPECT_EQ(bench.servo.power_limit(), 0.1);
  bench.run(500ms);
  // A pressing hand meets no limit on returned energy.
  EXPECT_EQ(bench.peak, [] {
    Bench same(floor(1425), {0, 0, 0.02}, pulled_off);
    same.run(500ms);
    return same.peak;
  }());
  bench.run(500ms);
  // For the speed at the start of a sample: within it the hand accelerates.
  EXPECT_GT(free.power, 0.3);
  EXPECT_LE(bench.power, 0.1 * 1.3);
  EXPECT_GE(bench.least, -1e-9);
  EXPECT_EQ(bench.too_fast, 0);
}

TEST(ForcePower, SlowContactWithAWallIsNotLimited) {
  Bench bench(floor(1425), {0, 0, 0.02}, pulled_off);
  EXPECT_EQ(bench.servo.power_limit(), SimulatedDeviceConfig().max_force * 1.0);
  ServoConfig more;
  more.max_power = 1e6;
  EXPECT_EQ(Bench(floor(1425), {0, 0, 0.02}, pulled_off, more).servo.power_limit(),
            bench.servo.power_limit());
}

TEST(ForceRate, IsKeptForAnyUpdates) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1, 1);
    Scene scene = floor(600);
    if (seed % 2 == 0) {
      SceneRegion& region = scene.regions.emplace_back();
      region.effects.declare<Oscillation>() = {1.0, 0.5, 2.0, 12.0 * seed};
    }
    Bench bench(scene, {0, 0, 0.02}, [seed](double t) {
      HandTarget hand;
      hand.position = {0.02 * std::sin(9 * t + seed), 0.02 * std::sin(15 * t),
                       0.02 * std::cos(12 * t)};
      return hand;
    });
    for (int i = 0; i < 300; ++i) {
      ContactSet set;
      set.count = 2;
      for (std::size_t k = 0; k < set.count; ++k) {
        RemoteHand& hand = set.hands[k];
        hand.id = {1, 2, static_cast<std::uint16_t>(k + 1)};
        hand.state.algorithm = pdu::DeadReckoningAlgorithm::fpw;
        hand.state.position = 0.04 * Vector3d(unit(random), unit(random), unit(random));
        hand.model.kind = pdu::ForceModelKind::sphere;
        hand.model.k1 = 900;
        hand.model.radius = 0.03;
        hand.valid_until = 100s;
        hand.version = static_cast<std::uint32_t>(i + 1);
        hand.given_to_us = 0.02 * i;
      }
      bench.servo.contacts().write(set);
      bench.run(10ms);
    }
    EXPECT_EQ(bench.too_fast, 0) << seed;
    EXPECT_GT(bench.peak, 1.0) << seed;
    EXPECT_GE(bench.least, -1e-9) << seed;
    EXPECT_GE(bench.snapshot().port_energy_min, -1e-9) << seed;
  }
}

TEST(ForceRate, TooLowARateIsRefused) {
  ServoConfig config;
  config.max_force_rate = 0;
  EXPECT_THROW(Bench(floor(500), {0, 0, 0.1}, {}, config), std::invalid_argument);
}

}  // namespace
}  // namespace reckon::haptics::force_limits_test
