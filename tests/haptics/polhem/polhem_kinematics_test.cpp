// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/polhem/polhem_kinematics.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <random>

#include "reckon/haptics/polhem/polhem_driver.hpp"

namespace reckon::haptics::polhem_kinematics_test {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Vector3d place(std::mt19937& random) {
  std::uniform_real_distribution<double> within(-1, 1);
  const double reach = polhem_facts().reach;
  return polhem_1().middle + reach * Vector3d(within(random), within(random), within(random));
}

Vector3d angles_in_the_work_space(std::mt19937& random) {
  const auto angles = polhem_angles(polhem_1(), place(random));
  EXPECT_TRUE(angles);
  return angles.value_or(Vector3d(0, 0, kPi / 2));
}

// Link by link, each turned and carried by the one before.
Vector3d chained(const Vector3d& angles) {
  const Eigen::Isometry3d base = Eigen::Translation3d(0, 0, 0.058) *
                                 AngleAxisd(angles[0], Vector3d::UnitZ()) *
                                 Eigen::Isometry3d::Identity();
  const Eigen::Isometry3d upper =
      base * AngleAxisd(angles[1], Vector3d::UnitY()) * Eigen::Translation3d(0, 0, 0.174);
  // Given relative to the upright axis: the upper link's turn is subtracted.
  return upper * AngleAxisd(-angles[1], Vector3d::UnitY()) *
         AngleAxisd(kPi - angles[2], Vector3d::UnitY()) * Vector3d(0, 0, 0.133);
}

TEST(PolhemKinematics, StartPoseHasLevelForeLink) {
  const auto& home = polhem_1().home_counts;
  const Vector3d angles = polhem_angles_at(polhem_1(), {home[0], home[1], home[2]});
  EXPECT_LT((angles - Vector3d(0, 0, kPi / 2)).norm(), 1e-12);
  const auto pose = polhem_pose(polhem_1(), angles);
  ASSERT_TRUE(pose);
  EXPECT_LT((pose->position - Vector3d(0.133, 0, 0.058 + 0.174)).norm(), 1e-12);
  // As seen by the operator, that is towards him, on the axis.
  EXPECT_LT(polhem_to_device(pose->position).y(), 0);
  EXPECT_EQ(device_to_polhem(polhem_to_device(pose->position)), pose->position);
}

TEST(PolhemKinematics, InverseAndForwardAgreeInTheWorkSpace) {
  std::mt19937 random(1);
  double most = 0, open = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Vector3d p = place(random);
    const auto angles = polhem_angles(polhem_1(), p);
    ASSERT_TRUE(angles) << p.transpose();
    open = std::max(open, (chained(*angles) - p).norm());
    const auto pose = polhem_pose(polhem_1(), *angles);
    ASSERT_TRUE(pose) << p.transpose();
    most = std::max(most, (pose->position - p).norm());
  }
  EXPECT_LT(most, 1e-12) << "[m]; the bar is 0.1 um";
  EXPECT_LT(open, 1e-12) << "[m], of the chain of links";
}

TEST(PolhemKinematics, JacobianIsTheSlopeOfThePosition) {
  std::mt19937 random(2);
  const double h = 1e-4;  // [rad]: rounding and fifth derivative are both below 1e-11
  double most = 0;
  for (int i = 0; i < 2'000; ++i) {
    const Vector3d angles = angles_in_the_work_space(random);
    const auto pose = polhem_pose(polhem_1(), angles);
    ASSERT_TRUE(pose);
    for (int k = 0; k < 3; ++k) {
      const Vector3d step = h * Vector3d::Unit(k);
      const Vector3d slope = (8 * (chained(angles + step) - chained(angles - step)) -
                              (chained(angles + 2 * step) - chained(angles - 2 * step))) /
                             (12 * h);
      most = std::max(most, (slope - pose->jacobian.col(k)).norm());
    }
  }
  EXPECT_LT(most, 1e-7);
}

TEST(PolhemKinematics, LeverIsTheGreatestDisplacementInTheMiddle) {
  const auto angles = polhem_angles(polhem_1(), polhem_1().middle);
  ASSERT_TRUE(angles);
  const auto pose = polhem_pose(polhem_1(), *angles);
  ASSERT_TRUE(pose);
  const Eigen::JacobiSVD<Eigen::Matrix3d> ways(pose->jacobian);
  EXPECT_NEAR(ways.singularValues()[0], polhem_facts().lever, 1e-6);
}

// A displacement of 1 m along an axis turns the joints, and their friction dissipates at each turn.
TEST(PolhemKinematics, JointFrictionMatchesTheHandlesInTheMiddle) {
  double least = std::numeric_limits<double>::infinity();
  constexpr double kWay = 1e-5;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d way = kWay * Vector3d::Unit(axis);  // its axes are those of frame D
    const auto more = polhem_angles(polhem_1(), polhem_1().middle + way);
    const auto less = polhem_angles(polhem_1(), polhem_1().middle - way);
    ASSERT_TRUE(more && less);
    least = std::min(least, (*more - *less).squaredNorm() / (4 * kWay * kWay));
  }
  EXPECT_NEAR(polhem_facts().joints_per_damping * least, 1.0, 1e-5) << "the facts' last digit";
}

TEST(PolhemKinematics, MotorsHaveThePowerOfTheForce) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> within(-1, 1);
  double most = 0;
  for (int i = 0; i < 2'000; ++i) {
    const auto pose = polhem_pose(polhem_1(), angles_in_the_work_space(random));
    ASSERT_TRUE(pose);
    const Vector3d force = 5 * Vector3d(within(random), within(random), within(random));
    const Vector3d turn(within(random), within(random), within(random));  // [rad/s]
    const Vector3d currents = polhem_currents(polhem_1(), polhem_torques(pose->jacobian, force));
    // From the motors themselves: 0.0538 N m/A, at eighteen or ten times the speed of their joints.
    const double power = -0.0538 * (18 * currents[0] * turn[0] + 10 * currents[1] * turn[1] +
                                    10 * currents[2] * turn[2]);
    most = std::max(most, std::abs(power - force.dot(pose->jacobian * turn)));
    EXPECT_LT(
        (polhem_torques_of(polhem_1(), currents) - polhem_torques(pose->jacobian, force)).norm(),
        1e-12);
  }
  EXPECT_LT(most, 1e-12) << "[W]";
}

// Three more joints after the links, and the whole as products of rotations written out.
TEST(PolhemKinematics, GimbalTurnsTheTool) {
  const Vector3d level(0, 0, kPi / 2);
  const auto turned = [&](const Vector3d& angles, std::array<std::int16_t, 3> gimbal) {
    return polhem_orientation(polhem_1(), angles, gimbal);
  };
  EXPECT_LT(turned(level, {0, 0, 0}).angularDistance(Eigen::Quaterniond::Identity()), 1e-12);
  // A quarter turn is 256 counts. The axes from the fore link outwards: along it, which is D's -y
  // towards the operator; across it, D's x; and along the tool.
  const auto is_turn = [&](const Eigen::Quaterniond& q, double angle, const Vector3d& axis) {
    return q.angularDistance(Eigen::Quaterniond(AngleAxisd(angle, axis))) < 1e-12;
  };
  EXPECT_TRUE(is_turn(turned(level, {256, 0, 0}), -kPi / 2, -Vector3d::UnitY()));
  EXPECT_TRUE(is_turn(turned(level, {0, 256, 0}), kPi / 2, Vector3d::UnitX()));
  EXPECT_TRUE(is_turn(turned(level, {0, 0, 256}), -kPi / 2, -Vector3d::UnitY()));
  // The base turns the tool about z, and a lowered fore link lowers its nose.
  EXPECT_TRUE(is_turn(turned({0.3, 0, kPi / 2}, {0, 0, 0}), 0.3, Vector3d::UnitZ()));
  EXPECT_TRUE(is_turn(turned({0, 0, kPi / 2 - 0.3}, {0, 0, 0}), 0.3, Vector3d::UnitX()));
  // The order: the outermost turn is about the tool as turned by the others.
  const Eigen::Quaterniond both = turned(level, {0, 256, 256});
  const Vector3d nose = both * -Vector3d::UnitY();
  EXPECT_LT((nose - turned(level, {0, 256, 0}) * -Vector3d::UnitY()).norm(), 1e-12);
}

TEST(PolhemKinematics, LinkSupportMakesNoEnergyOnAnyLoop) {
  const PolhemWeights weights{0.12, 0.05};
  std::mt19937 random(4);
  std::uniform_real_distribution<double> within(-0.3, 0.3);
  for (int loop = 0; loop < 20; ++loop) {
    const Vector3d u(within(random), within(random), within(random));
    const Vector3d w(within(random), within(random), within(random));
    const auto at = [&](double turn) {
      return Vector3d(Vector3d(0, 0.2, 1.5) + std::sin(turn) * u + std::sin(2 * turn) * w);
    };
    double work = 0;
    constexpr int kSteps = 2'000;
    for (int i = 0; i < kSteps; ++i) {
      const double from = 2 * kPi * i / kSteps, to = 2 * kPi * (i + 1) / kSteps;
      work += polhem_hold_up(weights, at((from + to) / 2)).dot(at(to) - at(from));
    }
    EXPECT_LT(std::abs(work), 1e-8);
  }
  // For two masses on the links: the supporting torque is the slope of their height times their
  // weight.
  const double h = 1e-5;
  const auto energy = [&](const Vector3d& q) {
    return weights.upper * std::cos(q[1]) - weights.fore * std::cos(q[2]);
  };
  for (int i = 0; i < 100; ++i) {
    const Vector3d angles = angles_in_the_work_space(random);
    for (int k = 0; k < 3; ++k) {
      const Vector3d step = h * Vector3d::Unit(k);
      EXPECT_NEAR(polhem_hold_up(weights, angles)[k],
                  (energy(angles + step) - energy(angles - step)) / (2 * h), 1e-9);
    }
  }
}

TEST(PolhemKinematics, RefusesSingularPosesAndOtherAssemblies) {
  EXPECT_FALSE(polhem_pose(polhem_1(), {0, 1.0, kPi - 1.0}));   // stretched
  EXPECT_FALSE(polhem_pose(polhem_1(), {0, 1.0, -1.0 + 0.1}));  // folded
  EXPECT_FALSE(polhem_pose(polhem_1(), {0, -0.5, kPi / 4}));    // across its own axis
  EXPECT_FALSE(polhem_pose(polhem_1(), {0, 1.0, kPi - 0.5}));   // the elbow in the other direction
  EXPECT_FALSE(polhem_pose(polhem_1(), {kNaN, 0, kPi / 2}));
  EXPECT_FALSE(polhem_pose(polhem_1(), {0, kNaN, kPi / 2}));
  EXPECT_FALSE(polhem_pose(polhem_1(), {0, 0, std::numeric_limits<double>::infinity()}));
  EXPECT_FALSE(polhem_angles(polhem_1(), {1, 0, 0}));
  EXPECT_FALSE(polhem_angles(polhem_1(), {0.01, 0, 0.058}));
  EXPECT_FALSE(polhem_angles(polhem_1(), {kNaN, 0, 0.1}));
}

TEST(PolhemKinematics, CountsAndAnglesConvertBeyondSixteenBits) {
  std::mt19937 random(5);
  std::uniform_int_distribution<std::int32_t> any(-100'000, 100'000);
  for (int i = 0; i < 1'000; ++i) {
    const std::array<std::int32_t, 3> counts{any(random), any(random), any(random)};
    EXPECT_EQ(polhem_counts_at(polhem_1(), polhem_angles_at(polhem_1(), counts)), counts);
  }
  EXPECT_EQ(polhem_counts_at(polhem_1(), Vector3d::Constant(1e300))[0],
            -std::numeric_limits<std::int32_t>::max());
}

// The limits of the arm that a servo gets hold over its work space.
TEST(PolhemKinematics, WorkSpaceMatchesTheReportedLimits) {
  const UsbFacts& facts = polhem_facts();
  double step = 0, least = 1, current = 0;
  for (int i = 0; i < 11 * 11 * 11; ++i) {
    const Vector3d cell(i % 11 - 5, i / 11 % 11 - 5, i / 121 - 5);
    const auto angles = polhem_angles(polhem_1(), polhem_1().middle + facts.reach / 5 * cell);
    ASSERT_TRUE(angles) << cell.transpose();
    const auto pose = polhem_pose(polhem_1(), *angles);
    ASSERT_TRUE(pose) << cell.transpose();
    const Matrix3d& j = pose->jacobian;
    step = std::max(step, (j.cwiseAbs() * polhem_count_steps(polhem_1())).maxCoeff());
    least = std::min(least, Eigen::JacobiSVD<Matrix3d>(j).singularValues()[2]);
    for (int k = 0; k < 3; ++k) {
      const Vector3d torque = facts.most_force * j.col(k).norm() * Vector3d::Unit(k);
      current = std::max(current, polhem_currents(polhem_1(), torque).cwiseAbs().maxCoeff());
    }
  }
  std::printf("step %.1f um, least lever %.4f m, most current %.2f A\n", 1e6 * step, least,
              current);
  EXPECT_LE(step, facts.resolution);
  EXPECT_GE(least, kPolhemLeastLever);
  EXPECT_LE(current, polhem_1().most_current);
}

}  // namespace
}  // namespace reckon::haptics::polhem_kinematics_test
