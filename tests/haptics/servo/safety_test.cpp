// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/servo/safety.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;

const Vector3d kStill = Vector3d::Zero();

DeviceSample good() {
  DeviceSample sample;
  sample.ok = true;
  return sample;
}

// A Safety with fully risen limits.
Safety ready(double max_force, double max_power, double max_speed, int hold_steps) {
  Safety safety(max_force, max_power, max_speed, hold_steps);
  for (int i = 0; i < Safety::kRampSteps; ++i) (void)safety.admit(good(), kStill);
  return safety;
}

TEST(Safety, SaturatesWithoutTurningTheForce) {
  Safety safety = ready(8.0, 2.0, 1.0, 10);
  const Vector3d wanted(30, -40, 0);
  const Vector3d written = safety.scale(wanted, kStill) * wanted;
  EXPECT_NEAR(written.norm(), 8.0, 1e-12);
  EXPECT_LE(written.cross(wanted).norm(), 1e-12);
  EXPECT_EQ(safety.scale(Vector3d(1, 2, 3), kStill), 1.0);
  EXPECT_EQ(safety.trips(), 0u);
}

// The time until the limit begins to fall, and its fall, by the closed forms.
TEST(Safety, WarmMotorsKeepOnlyTheirContinuousForce) {
  constexpr double kMost = 8.0, kContinuous = 2.0, kTau = 20e3;  // [N], [N], [samples]
  Safety safety = ready(kMost, 100.0, 1.0, 10);
  safety.limit_heat(kContinuous, kTau);
  const Vector3d wanted(0, 0, kMost);
  const double load = std::pow(kMost / kContinuous, 2);
  // F_c^2 (h + q (1 - h)) = F^2
  const double warm = (MotorHeat::kQuick - load) / (MotorHeat::kQuick - 1);
  const double full = -kTau * std::log(1 - warm / load);
  int at_full = 0;
  double shown = 1, before = 1, squares = 0;
  const int steps = static_cast<int>(5 * kTau);
  for (int i = 0; i < steps; ++i) {
    (void)safety.admit(good(), kStill);
    shown = safety.scale(wanted, kStill);
    ASSERT_LE(shown, before) << i;
    before = shown;
    if (shown == 1.0) ++at_full;
    squares += std::pow(shown * kMost, 2);
  }
  EXPECT_NEAR(at_full, full, 2);
  EXPECT_NEAR(shown * kMost, kContinuous, 1e-6);
  // The excess is limited to the heat of one time constant.
  EXPECT_LE(squares / (kContinuous * kContinuous), steps + kTau);
  EXPECT_GE(squares / (kContinuous * kContinuous), steps + 0.95 * kTau);
  // It cools while no force is shown, with or without a trip.
  for (int i = 0; i < static_cast<int>(kTau); ++i) (void)safety.admit({}, kStill);
  for (int i = 0; i < 20 + Safety::kRampSteps; ++i) (void)safety.admit(good(), kStill);
  EXPECT_EQ(safety.scale(wanted, kStill), 1.0);
  EXPECT_EQ(safety.scale(0.1 * wanted, kStill), 1.0);
}

TEST(Safety, ContinuousForceIsNeverCut) {
  Safety safety = ready(8.0, 100.0, 1.0, 10);
  safety.limit_heat(2.0, 1000);
  for (int i = 0; i < 20'000; ++i) {
    (void)safety.admit(good(), kStill);
    ASSERT_EQ(safety.scale(Vector3d(0, 1.2, 1.59), kStill), 1.0) << i;
  }
}

Wrench wrench(const Vector3d& force, const Vector3d& torque) {
  Wrench both;
  both << force, torque;
  return both;
}

TEST(Safety, LimitsForceTorqueAndPowerByOneShare) {
  Safety safety = ready(8.0, 2.0, 1.0, 10);
  safety.limit_turns(0.5, 20.0);
  const Wrench still = Wrench::Zero();
  EXPECT_EQ(safety.scale(wrench({1, 0, 0}, {0, 0.4, 0}), still), 1.0);
  EXPECT_NEAR(safety.scale(wrench({16, 0, 0}, {0, 0.4, 0}), still), 0.5, 1e-12) << "by the force";
  EXPECT_NEAR(safety.scale(wrench({9, 0, 0}, {0, 0, 2}), still), 0.25, 1e-12) << "by the torque";
  EXPECT_NEAR(safety.scale(wrench({4, 0, 0}, {0, 0, 0.2}), wrench({0.5, 0, 0}, {0, 0, 10})), 0.5,
              1e-12)
      << "4 W of 2";
  EXPECT_EQ(safety.scale(wrench({NAN, 0, 0}, {0, 0, 0}), still), 0.0);
  EXPECT_EQ(safety.last_trip(), Trip::not_finite);
  for (int i = 0; i < 20; ++i) (void)safety.admit(good(), still);
  EXPECT_EQ(safety.admit(good(), wrench({0, 0, 0}, {12, 12, 12})), Admission::cut);
  EXPECT_EQ(safety.last_trip(), Trip::overspeed);
}

TEST(Safety, LimitsThePowerOfAYieldingContact) {
  Safety safety = ready(8.0, 2.0, 1.0, 10);
  const Vector3d force(3, 0, 4);
  EXPECT_EQ(safety.scale(force, Vector3d(-1, 0, -1)), 1.0) << "the hand puts it in";
  EXPECT_EQ(safety.scale(force, Vector3d(4, 0, -3)), 1.0) << "across";
  EXPECT_EQ(safety.scale(force, Vector3d(0.1, 0, 0.2)), 1.0) << "1.1 W";
  EXPECT_NEAR(safety.scale(force, Vector3d(0.4, 0, 0.7)), 2.0 / 4.0, 1e-12);
  EXPECT_NEAR(safety.scale(Vector3d(10 * force), Vector3d(0.4, 0, 0.7)), 2.0 / 40.0, 1e-12);
  EXPECT_EQ(safety.trips(), 0u);
}

TEST(Safety, CutsNonFiniteForces) {
  Safety safety(8.0, 2.0, 1.0, 10);
  ASSERT_EQ(safety.admit(good(), kStill), Admission::shown);
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(safety.scale(Vector3d(bad, 0, 0), kStill), 0.0);
  }
  EXPECT_EQ(safety.last_trip(), Trip::not_finite);
  for (int i = 0; i < 9; ++i) EXPECT_EQ(safety.admit(good(), kStill), Admission::cut);
  EXPECT_EQ(safety.admit(good(), kStill), Admission::shown);
  EXPECT_EQ(safety.trips(), 1u);
}

TEST(Safety, TripsOnceForALastingCause) {
  Safety safety(8.0, 2.0, 1.0, 10);
  for (int i = 0; i < 50; ++i) EXPECT_EQ(safety.admit(good(), Vector3d(2, 0, 0)), Admission::cut);
  EXPECT_EQ(safety.trips(), 1u);
  EXPECT_EQ(safety.last_trip(), Trip::overspeed);
}

TEST(Safety, CountsLostReadingsAndTheDevicesOwnWatchdog) {
  Safety safety(8.0, 2.0, 1.0, 2);
  DeviceSample lost = good();
  lost.ok = false;
  for (int i = 0; i < Safety::kMostMissed; ++i) {
    EXPECT_EQ(safety.admit(lost, kStill), Admission::paused);
    EXPECT_EQ(safety.admit(good(), kStill), Admission::shown);
  }
  EXPECT_EQ(safety.admit(lost, kStill), Admission::cut);
  EXPECT_EQ(safety.last_trip(), Trip::no_reading);
  DeviceSample let_go = good();
  let_go.watchdog = true;
  EXPECT_EQ(safety.admit(let_go, kStill), Admission::cut);
  EXPECT_EQ(safety.last_trip(), Trip::watchdog);
  EXPECT_EQ(safety.trips(), 2u);
}

TEST(Safety, ForgetsAFailedReadingAfterHalfASecond) {
  Safety safety(8.0, 2.0, 1.0, 10);
  DeviceSample lost = good();
  lost.ok = false;
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(safety.admit(lost, kStill), Admission::paused);
    for (int k = 0; k < Safety::kForgiven; ++k) (void)safety.admit(good(), kStill);
  }
  EXPECT_EQ(safety.trips(), 0u);
}

TEST(Safety, ReleasedSwitchCutsTheForceWithoutATrip) {
  Safety safety(8.0, 2.0, 1.0, 10);
  DeviceSample released = good();
  released.enabled = false;
  EXPECT_EQ(safety.admit(released, kStill), Admission::cut);
  EXPECT_EQ(safety.admit(good(), kStill), Admission::shown);
  EXPECT_EQ(safety.trips(), 0u);
}

// 8 N and 0.4 N m in 100 samples: the force may grow by 80 mN and the torque by 4 mN m in each.
TEST(Safety, LimitsRiseEvenlyAfterEachCut) {
  Safety safety(8.0, 1e3, 1.0, 10);
  safety.limit_turns(0.4, 20.0);
  const Wrench still = Wrench::Zero();
  const Wrench pushed = wrench({20, 0, 0}, Vector3d::Zero());
  const Wrench turned = wrench(Vector3d::Zero(), {0, 0, 20});
  const auto rises = [&](const char* after) {
    for (int step = 1; step <= 150; ++step) {
      ASSERT_EQ(safety.admit(good(), still), Admission::shown) << after;
      const double share = std::min(1.0, step / 100.0);
      EXPECT_NEAR(20 * safety.scale(pushed, still), 8.0 * share, 1e-12) << after << ' ' << step;
      EXPECT_NEAR(20 * safety.scale(turned, still), 0.4 * share, 1e-12) << after << ' ' << step;
    }
  };
  rises("start");
  DeviceSample released = good();
  released.enabled = false;
  (void)safety.admit(released, still);
  rises("switch");
  (void)safety.admit(good(), wrench({2, 0, 0}, Vector3d::Zero()));
  while (safety.admit(good(), still) == Admission::cut) {
  }
  EXPECT_LE(20 * safety.scale(pushed, still), 0.08 + 1e-12) << "after a trip";
}

TEST(Safety, FailedReadingDoesNotRestartTheRise) {
  Safety safety = ready(8.0, 2.0, 1.0, 10);
  DeviceSample lost = good();
  lost.ok = false;
  ASSERT_EQ(safety.admit(lost, kStill), Admission::paused);
  ASSERT_EQ(safety.admit(good(), kStill), Admission::shown);
  EXPECT_EQ(safety.scale(Vector3d(8, 0, 0), kStill), 1.0);
}

}  // namespace
}  // namespace reckon::haptics
