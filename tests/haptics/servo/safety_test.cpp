// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/servo/safety.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;

DeviceSample good() {
  DeviceSample sample;
  sample.ok = true;
  return sample;
}

TEST(Safety, SaturatesWithoutTurningTheForce) {
  Safety safety(8.0, 2.0, 1.0, 10);
  const Vector3d wanted(30, -40, 0);
  const Vector3d written = safety.scale(wanted, Vector3d::Zero()) * wanted;
  EXPECT_NEAR(written.norm(), 8.0, 1e-12);
  EXPECT_LE(written.cross(wanted).norm(), 1e-12);
  EXPECT_EQ(safety.scale(Vector3d(1, 2, 3), Vector3d::Zero()), 1.0);
  EXPECT_EQ(safety.trips(), 0u);
}

TEST(Safety, LimitsThePowerOfAForceThatAHandGivesWayTo) {
  Safety safety(8.0, 2.0, 1.0, 10);
  const Vector3d force(3, 0, 4);
  EXPECT_EQ(safety.scale(force, Vector3d(-1, 0, -1)), 1.0) << "the hand puts it in";
  EXPECT_EQ(safety.scale(force, Vector3d(4, 0, -3)), 1.0) << "across";
  EXPECT_EQ(safety.scale(force, Vector3d(0.1, 0, 0.2)), 1.0) << "1.1 W";
  EXPECT_NEAR(safety.scale(force, Vector3d(0.4, 0, 0.7)), 2.0 / 4.0, 1e-12);
  EXPECT_NEAR(safety.scale(10 * force, Vector3d(0.4, 0, 0.7)), 2.0 / 40.0, 1e-12);
  EXPECT_EQ(safety.trips(), 0u);
}

TEST(Safety, CutsForcesThatAreNotNumbersAndHolds) {
  Safety safety(8.0, 2.0, 1.0, 10);
  ASSERT_EQ(safety.admit(good(), Vector3d::Zero()), Admission::shown);
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(safety.scale(Vector3d(bad, 0, 0), Vector3d::Zero()), 0.0);
  }
  EXPECT_EQ(safety.last_trip(), Trip::not_finite);
  for (int i = 0; i < 9; ++i) EXPECT_EQ(safety.admit(good(), Vector3d::Zero()), Admission::cut);
  EXPECT_EQ(safety.admit(good(), Vector3d::Zero()), Admission::shown);
  EXPECT_EQ(safety.trips(), 1u);
}

TEST(Safety, TripsOnceForACauseThatLasts) {
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
    EXPECT_EQ(safety.admit(lost, Vector3d::Zero()), Admission::paused);
    EXPECT_EQ(safety.admit(good(), Vector3d::Zero()), Admission::shown);
  }
  EXPECT_EQ(safety.admit(lost, Vector3d::Zero()), Admission::cut);
  EXPECT_EQ(safety.last_trip(), Trip::no_reading);
  DeviceSample let_go = good();
  let_go.watchdog = true;
  EXPECT_EQ(safety.admit(let_go, Vector3d::Zero()), Admission::cut);
  EXPECT_EQ(safety.last_trip(), Trip::watchdog);
  EXPECT_EQ(safety.trips(), 2u);
}

TEST(Safety, ForgetsAFailedReadingAfterHalfASecond) {
  Safety safety(8.0, 2.0, 1.0, 10);
  DeviceSample lost = good();
  lost.ok = false;
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(safety.admit(lost, Vector3d::Zero()), Admission::paused);
    for (int k = 0; k < Safety::kForgiven; ++k) (void)safety.admit(good(), Vector3d::Zero());
  }
  EXPECT_EQ(safety.trips(), 0u);
}

TEST(Safety, AReleasedSwitchCutsTheForceWithoutATrip) {
  Safety safety(8.0, 2.0, 1.0, 10);
  DeviceSample released = good();
  released.enabled = false;
  EXPECT_EQ(safety.admit(released, Vector3d::Zero()), Admission::cut);
  EXPECT_EQ(safety.admit(good(), Vector3d::Zero()), Admission::shown);
  EXPECT_EQ(safety.trips(), 0u);
}

}  // namespace
}  // namespace reckon::haptics
