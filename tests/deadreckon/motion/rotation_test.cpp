// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/deadreckon/motion/rotation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "reckon/tests/deadreckon/support/oracle.hpp"

namespace reckon::deadreckon {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using test::Random;

TEST(Rotation, MeetsEverySlerpOracle) {
  RECKON_NEED_DATA("oracles/convergence.json");
  int checked = 0;
  const auto file = test::oracle("convergence.json");
  for (const auto& v : file.at("quaternion")) {
    const Quaterniond q0 = test::quaternion(v.at("q0")), q1 = test::quaternion(v.at("q1"));
    const Vector3d turn = logarithm(q0.conjugate() * q1);
    const Quaterniond q = (q0 * exponential(test::number(v.at("s")) * turn)).normalized();
    const double tolerance = test::number(v.at("tol"));
    EXPECT_LE(test::difference(q, test::quaternion(v.at("expected_q"))), tolerance) << v.at("id");

    const double angle = angle_between(q0, q1);
    EXPECT_NEAR(angle, test::number(v.at("angle")), 1e-14) << v.at("id");
    const auto& threshold = v.at("threshold_exceeded_at");
    EXPECT_EQ(angle > test::number(threshold.at("thresh_rad")), threshold.at("value").get<bool>());
    ++checked;
  }
  EXPECT_EQ(checked, 28);
}

TEST(Rotation, LogarithmUndoesExponentialFromZeroToPi) {
  Random random(1);
  for (double angle = 1e-300; angle < 3.1415; angle *= 1.5) {
    const Vector3d v = angle * random.direction();
    EXPECT_LE((logarithm(exponential(v)) - v).norm(), 1e-15 + 4e-16 * angle) << angle;
  }
  EXPECT_EQ(exponential(Vector3d::Zero()).coeffs(), Quaterniond::Identity().coeffs());
  EXPECT_EQ(logarithm(Quaterniond::Identity()), Vector3d::Zero());
}

// On both sides of the end of the series, in long double.
TEST(Rotation, SmallTurnsAreExactToRounding) {
  const Vector3d axis = Vector3d(1, -2, 2) / 3;
  for (long double angle = 1e-9L; angle < 0.2L; angle *= 1.07L) {
    const Quaterniond q = exponential(static_cast<double>(angle) * axis);
    const long double half = static_cast<long double>(static_cast<double>(angle)) / 2;
    EXPECT_NEAR(q.w(), static_cast<double>(std::cos(half)), 2e-16) << static_cast<double>(angle);
    EXPECT_NEAR(q.vec().norm() / static_cast<double>(std::sin(half)), 1, 6e-16);
    Quaterniond exact;
    exact.w() = static_cast<double>(std::cos(half));
    exact.vec() = static_cast<double>(std::sin(half)) * axis;
    EXPECT_NEAR(logarithm(exact).norm() / static_cast<double>(2 * half), 1, 6e-16);
    EXPECT_NEAR(angle_between(Quaterniond::Identity(), exact) / static_cast<double>(2 * half), 1,
                6e-16);
  }
}

TEST(Rotation, AngleIgnoresTheQuaternionsSign) {
  Random random(2);
  const Quaterniond q = random.rotation();
  const Quaterniond opposite(-q.w(), -q.x(), -q.y(), -q.z());
  EXPECT_LE(angle_between(q, opposite), 1e-15);
  const Quaterniond near = q * exponential(1e-9 * random.direction());
  EXPECT_NEAR(angle_between(opposite, near), 1e-9, 1e-15);
}

TEST(Rotation, RateOfRotationVectorGivesItsAngularVelocity) {
  Random random(3);
  for (double angle = 1e-9; angle < 3.14; angle *= 1.7) {
    const Vector3d v = angle * random.direction(), w = random.vector(5);
    const Vector3d rate = rate_of_rotation_vector(v, w);
    EXPECT_LE((angular_velocity_of(v, rate) - w).norm(), 1e-13) << angle;

    // Against finite differences of the exponential itself.
    constexpr double h = 1e-5;
    const Quaterniond before = exponential(v - h * rate), after = exponential(v + h * rate);
    const Vector3d seen = logarithm(before.conjugate() * after) / (2 * h);
    EXPECT_LE((seen - w).norm(), 1e-7) << angle;
  }
}

}  // namespace
}  // namespace reckon::deadreckon
