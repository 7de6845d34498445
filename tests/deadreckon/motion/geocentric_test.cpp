// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/deadreckon/motion/geocentric.hpp"

#include <gtest/gtest.h>

#include <GeographicLib/LocalCartesian.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "reckon/tests/deadreckon/support/oracle.hpp"

namespace reckon::deadreckon {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using test::Random;
constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180;

TEST(Geocentric, EqualsGeographicLibFromPoleToPole) {
  Random random(1);
  const GeographicLib::Geocentric& earth = GeographicLib::Geocentric::WGS84();
  double worst = 0;
  for (int i = 0; i < 20000; ++i) {
    const double latitude = random.real(-90, 90), longitude = random.real(-180, 180),
                 height = random.real(-1e4, 1e5);
    Vector3d expected;
    earth.Forward(latitude, longitude, height, expected.x(), expected.y(), expected.z());
    const Vector3d got = geocentric_position(latitude * kDegree, longitude * kDegree, height);
    worst = std::max(worst, (got - expected).norm());
  }
  std::printf("worst geocentric difference %.2g m\n", worst);
  EXPECT_LE(worst, 1e-8);
}

TEST(Geocentric, LocalFrameEqualsGeographicLibsLocalCartesian) {
  Random random(2);
  double worst = 0;
  for (int i = 0; i < 2000; ++i) {
    const double latitude = random.real(-90, 90), longitude = random.real(-180, 180),
                 height = random.real(0, 5000);
    const GeographicLib::LocalCartesian reference(latitude, longitude, height);
    const LocalFrame frame(latitude * kDegree, longitude * kDegree, height);
    const double there = std::min(89.9, std::max(-89.9, latitude + random.real(-1, 1))),
                 across = longitude + random.real(-1, 1), above = random.real(0, 5000);
    Vector3d expected;
    reference.Forward(there, across, above, expected.x(), expected.y(), expected.z());
    const Vector3d world = geocentric_position(there * kDegree, across * kDegree, above);
    worst = std::max(worst, (frame.scene_from_world(world) - expected).norm());
  }
  std::printf("worst local difference %.2g m\n", worst);
  EXPECT_LE(worst, 1e-8);
}

TEST(Geocentric, LocalAxesAreEastNorthUp) {
  const LocalFrame frame(0, 0, 0);
  EXPECT_LE((frame.world_from_scene(Vector3d::Zero()) - Vector3d(6378137, 0, 0)).norm(), 1e-9);
  EXPECT_LE((frame.world_from_scene_vector(Vector3d::UnitX()) - Vector3d::UnitY()).norm(), 1e-15);
  EXPECT_LE((frame.world_from_scene_vector(Vector3d::UnitY()) - Vector3d::UnitZ()).norm(), 1e-15);
  EXPECT_LE((frame.world_from_scene_vector(Vector3d::UnitZ()) - Vector3d::UnitX()).norm(), 1e-15);
}

TEST(Geocentric, RoundTripsThroughTheWorld) {
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const LocalFrame frame(random.real(-kPi / 2, kPi / 2), random.real(-kPi, kPi), 100);
    const Vector3d point = random.vector(1000), v = random.vector(10);
    EXPECT_LE((frame.scene_from_world(frame.world_from_scene(point)) - point).norm(), 3e-9);
    EXPECT_LE((frame.scene_from_world_vector(frame.world_from_scene_vector(v)) - v).norm(), 1e-14);

    // Rotations and vectors turn in the same way.
    const Quaterniond q = random.rotation();
    EXPECT_LE(test::difference(frame.scene_from_world(frame.world_from_scene(q)), q), 1e-15);
    EXPECT_LE((frame.world_from_scene(q) * v - frame.world_from_scene_vector(q * v)).norm(), 1e-13);
  }
}

TEST(Geocentric, RefusesAnOriginThatIsNotOnEarth) {
  EXPECT_THROW(LocalFrame(1.6, 0, 0), std::invalid_argument);
  EXPECT_THROW(LocalFrame(0, 7, 0), std::invalid_argument);
  EXPECT_THROW(LocalFrame(0, 0, 1e9), std::invalid_argument);
  try {
    LocalFrame(std::numeric_limits<double>::quiet_NaN(), 0, 0);
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_NE(std::string(e.what()).find("latitude"), std::string::npos);
  }
}

// The definition in the standard, by matrices: world to body is Rx(phi) Ry(theta) Rz(psi) of
// frames.
Quaterniond by_definition(const Euler& e) {
  return Eigen::AngleAxisd(e.psi, Vector3d::UnitZ()) *
         Eigen::AngleAxisd(e.theta, Vector3d::UnitY()) *
         Eigen::AngleAxisd(e.phi, Vector3d::UnitX());
}

TEST(Euler, TurnsAboutZThenYThenX) {
  Random random(4);
  for (int i = 0; i < 1000; ++i) {
    const Euler e = {random.real(-7, 7), random.real(-7, 7), random.real(-7, 7)};
    EXPECT_LE(test::difference(quaternion_from_euler(e), by_definition(e)), 1e-15);
  }
}

TEST(Euler, RoundTripsEveryOrientationAndStaysInRange) {
  Random random(5);
  for (int i = 0; i < 20000; ++i) {
    const Quaterniond q = random.rotation();
    const Euler e = euler_from_quaternion(q);
    EXPECT_LE(test::difference(quaternion_from_euler(e), q), 2e-15);
    EXPECT_LE(std::abs(e.psi), kPi);
    EXPECT_LE(std::abs(e.theta), kPi / 2 + 1e-15);
    EXPECT_LE(std::abs(e.phi), kPi);
  }
}

TEST(Euler, KeepsItsDigitsAtAndNearGimbalLock) {
  Random random(6);
  for (double off = 1e-17; off < 0.1; off *= 3) {
    for (const double side : {-1.0, 1.0}) {
      const Euler e = {random.real(-3, 3), side * (kPi / 2 - off), random.real(-3, 3)};
      const Quaterniond q = quaternion_from_euler(e);
      const Euler back = euler_from_quaternion(q);
      EXPECT_LE(test::difference(quaternion_from_euler(back), q), 2e-15) << off;
      EXPECT_NEAR(back.theta, e.theta, 1e-15 + 4e-16) << off;
    }
  }
  const Euler up = euler_from_quaternion(quaternion_from_euler({0.5, kPi / 2, 0.2}));
  EXPECT_EQ(up.phi, 0);
  EXPECT_NEAR(up.psi, 0.3, 1e-15);
}

TEST(Euler, ReturnsOracleAnglesAwayFromTheLock) {
  RECKON_NEED_DATA("oracles/dead_reckoning.json");
  const auto file = test::oracle("dead_reckoning.json");
  for (const auto& v : file.at("vectors")) {
    const auto& main = v.at("expected").at("main");
    if (main.at("euler").is_null()) continue;
    const Euler e = euler_from_quaternion(test::quaternion(main.at("q_bw")));
    const Vector3d expected = test::vector(main.at("euler"));
    // Near the lock the quaternion determines only the sum of psi and phi.
    const double scale = 1.0 / std::cos(expected.y());
    EXPECT_LE(std::abs(std::remainder(e.psi - expected.x(), 2 * kPi)), 1e-15 * scale + 1e-15);
    EXPECT_NEAR(e.theta, expected.y(), 1e-15);
    EXPECT_LE(std::abs(std::remainder(e.phi - expected.z(), 2 * kPi)), 1e-15 * scale + 1e-15);
  }
}

}  // namespace
}  // namespace reckon::deadreckon
