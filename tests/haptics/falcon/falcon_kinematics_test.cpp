// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/falcon/falcon_kinematics.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "reckon/haptics/falcon/falcon_driver.hpp"

namespace reckon::haptics::falcon_kinematics_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using G = FalconGeometry;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Vector3d place(std::mt19937& random) {
  std::uniform_real_distribution<double> within(-G::kReach, G::kReach);
  return {within(random), within(random), G::kMiddle + within(random)};
}

// The chain of each leg, joint by joint, as in open drivers: the residual of the three equations
// between the angles and a position, after the two inner angles are eliminated from two of them.
// Dimensions in metres, written out independently.
Vector3d left_over(const Vector3d& angles, const Vector3d& p) {
  Vector3d left;
  for (int i = 0; i < 3; ++i) {
    const double phi = G::kLegs[static_cast<std::size_t>(i)];
    const double u = std::cos(phi) * p.x() + std::sin(phi) * p.y() - 0.04;
    const double v = -std::sin(phi) * p.x() + std::cos(phi) * p.y() + 0.02309;
    const double third = std::acos((v - 0.025) / 0.1025);
    const double fold = 0.01125 + 0.01125 + 0.1025 * std::sin(third);
    const double second =
        std::atan2(p.z() - 0.06 * std::sin(angles[i]), u + 0.01443 - 0.06 * std::cos(angles[i]));
    left[i] = std::hypot(u - (0.06 * std::cos(angles[i]) - 0.01443 + fold * std::cos(second)),
                         p.z() - (0.06 * std::sin(angles[i]) + fold * std::sin(second)));
  }
  return left;
}

TEST(FalconKinematics, InverseAndForwardAgreeInTheWorkSpace) {
  std::mt19937 random(1);
  double most = 0;
  double open = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Vector3d p = place(random);
    const auto angles = falcon_angles(p);
    ASSERT_TRUE(angles) << p.transpose();
    open = std::max(open, left_over(*angles, p).maxCoeff());
    const auto pose = falcon_pose(*angles);
    ASSERT_TRUE(pose) << p.transpose();
    most = std::max(most, (pose->position - p).norm());
  }
  EXPECT_LT(most, 1e-10) << "[m]; the bar is 0.1 um";
  EXPECT_LT(open, 1e-15) << "[m], of the chain of each leg";
}

TEST(FalconKinematics, ReachesTheCornersOfItsWorkSpace) {
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3d p =
        Vector3d(0, 0, G::kMiddle) +
        G::kReach * Vector3d((corner & 1) ? 1 : -1, (corner & 2) ? 1 : -1, (corner & 4) ? 1 : -1);
    const auto angles = falcon_angles(p);
    ASSERT_TRUE(angles) << p.transpose();
    const auto pose = falcon_pose(*angles);
    ASSERT_TRUE(pose) << p.transpose();
    EXPECT_LT((pose->position - p).norm(), 1e-10);
  }
}

TEST(FalconKinematics, EqualAnglesGiveAPositionOnTheAxis) {
  // By symmetry the handle's offset across the legs turns it only about the axis.
  for (const double degrees : {0.0, 20.0, 35.0, 60.0}) {
    const auto pose = falcon_pose(Vector3d::Constant(degrees * std::numbers::pi / 180.0));
    ASSERT_TRUE(pose);
    EXPECT_LT(pose->position.head<2>().norm(), 1e-12);
    EXPECT_GT(pose->position.z(), 0.06);
    EXPECT_LT(pose->position.z(), 0.183);
  }
}

TEST(FalconKinematics, JacobianIsTheSlopeOfThePosition) {
  std::mt19937 random(2);
  const double h = 1e-5;  // [rad]: rounding and third derivative are both below 1e-9
  double most = 0;
  for (int i = 0; i < 2'000; ++i) {
    const auto angles = falcon_angles(place(random));
    ASSERT_TRUE(angles);
    const auto pose = falcon_pose(*angles);
    ASSERT_TRUE(pose);
    Matrix3d slope;
    for (int k = 0; k < 3; ++k) {
      const auto more = falcon_pose(*angles + h * Vector3d::Unit(k));
      const auto less = falcon_pose(*angles - h * Vector3d::Unit(k));
      const auto most_of = falcon_pose(*angles + 2 * h * Vector3d::Unit(k));
      const auto least = falcon_pose(*angles - 2 * h * Vector3d::Unit(k));
      ASSERT_TRUE(more && less && most_of && least);
      slope.col(k) =
          (8 * (more->position - less->position) - (most_of->position - least->position)) /
          (12 * h);
    }
    most = std::max(most, (slope - pose->jacobian).cwiseAbs().maxCoeff());
  }
  EXPECT_LT(most, 1e-7) << "[m/rad]";
}

TEST(FalconKinematics, LeverIsTheGreatestDisplacementInTheMiddle) {
  const auto angles = falcon_angles(Vector3d(0, 0, G::kMiddle));
  ASSERT_TRUE(angles);
  const auto pose = falcon_pose(*angles);
  ASSERT_TRUE(pose);
  const Eigen::JacobiSVD<Matrix3d> ways(pose->jacobian);
  EXPECT_NEAR(ways.singularValues()[0], G::kLever, 1e-6);
}

// A displacement of 1 m along an axis turns the joints, and their friction dissipates at each turn.
TEST(FalconKinematics, JointFrictionMatchesTheHandlesInTheMiddle) {
  const auto angles = falcon_angles(Vector3d(0, 0, G::kMiddle));
  ASSERT_TRUE(angles);
  double least = std::numeric_limits<double>::infinity();
  constexpr double kWay = 1e-5;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d way = falcon_axes(kWay * Vector3d::Unit(axis));
    const auto more = falcon_angles(Vector3d(0, 0, G::kMiddle) + way);
    const auto less = falcon_angles(Vector3d(0, 0, G::kMiddle) - way);
    ASSERT_TRUE(more && less);
    least = std::min(least, (*more - *less).squaredNorm() / (4 * kWay * kWay));
  }
  EXPECT_NEAR(falcon_facts().joints_per_damping * least, 1.0, 1e-5) << "the facts' last digit";
}

TEST(FalconKinematics, TorquesHaveThePowerOfTheForce) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int i = 0; i < 10'000; ++i) {
    const auto angles = falcon_angles(place(random));
    ASSERT_TRUE(angles);
    const auto pose = falcon_pose(*angles);
    ASSERT_TRUE(pose);
    const Vector3d force = 8.9 * Vector3d(any(random), any(random), any(random));
    const Vector3d turn(any(random), any(random), any(random));
    EXPECT_NEAR(falcon_torques(pose->jacobian, force).dot(turn), force.dot(pose->jacobian * turn),
                1e-12);
  }
}

TEST(FalconKinematics, GivesNothingWithoutAPosition) {
  EXPECT_FALSE(falcon_angles({0, 0, 0.19}));   // beyond the arms' reach
  EXPECT_FALSE(falcon_angles({0, 0, 0.055}));  // between the arms
  EXPECT_FALSE(falcon_angles({0.2, 0, 0.115}));
  EXPECT_FALSE(falcon_pose({std::numbers::pi, 0, 0}));
  EXPECT_FALSE(falcon_pose({2, -1, 2}));
  for (int k = 0; k < 3; ++k) {
    for (const double odd : {kNaN, std::numeric_limits<double>::infinity()}) {
      Vector3d v(0, 0, G::kMiddle);
      v[k] = odd;
      EXPECT_FALSE(falcon_pose(v));
      EXPECT_FALSE(falcon_angles(v));
    }
  }
}

// For any counts: the result is a position of these angles, or none.
TEST(FalconKinematics, NeverGivesAPositionOfOtherAngles) {
  std::mt19937 random(4);
  std::uniform_int_distribution<int> any(-4000, 4000);
  std::uint64_t answered = 0;
  for (int i = 0; i < 100'000; ++i) {
    Vector3d angles;
    for (double& angle : angles) angle = falcon_angle(static_cast<std::int16_t>(any(random)));
    const auto pose = falcon_pose(angles);
    if (!pose) continue;
    ++answered;
    ASSERT_TRUE(pose->position.allFinite() && pose->jacobian.allFinite());
    const auto back = falcon_angles(pose->position);
    ASSERT_TRUE(back) << angles.transpose();
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(std::remainder((*back)[k] - angles[k], 2 * std::numbers::pi), 0, 1e-6);
    }
  }
  EXPECT_GT(answered, 1'000U);
}

TEST(FalconKinematics, CountsAndAnglesAgree) {
  EXPECT_NEAR(falcon_angle(0) * 180 / std::numbers::pi, 35.0, 1e-12);
  EXPECT_NEAR(falcon_angle(1000) * 180 / std::numbers::pi, 35.0 + 36.435, 1e-3);
  for (int count = -3000; count <= 3000; ++count) {
    EXPECT_EQ(falcon_count(falcon_angle(static_cast<std::int16_t>(count))), count);
  }
  EXPECT_EQ(falcon_count(1e9), 32767);
  EXPECT_EQ(falcon_count(-1e9), -32768);
  EXPECT_EQ(falcon_count(kNaN), -32768);
  // One count moves the handle by some 41 um in the middle.
  const auto angles = falcon_angles({0, 0, G::kMiddle});
  ASSERT_TRUE(angles);
  const auto pose = falcon_pose(*angles);
  ASSERT_TRUE(pose);
  EXPECT_NEAR(falcon_count_step() * pose->jacobian.col(0).norm(), 41e-6, 6e-6);
}

TEST(FalconKinematics, DeviceFrameIsRightAwayUp) {
  EXPECT_EQ(device_place({0, 0, G::kMiddle}), Vector3d(0, 0, 0));
  EXPECT_EQ(device_axes({0, 0, 1}), Vector3d(0, -1, 0)) << "towards the operator";
  EXPECT_EQ(device_axes({0, 1, 0}), Vector3d(0, 0, 1)) << "up";
  const Vector3d v(1, 2, 3);
  EXPECT_EQ(device_axes(falcon_axes(v)), v);
}

TEST(FalconKinematics, WorkSpaceStepsAreWithinTheResolution) {
  std::mt19937 random(5);
  double most = 0;
  for (int i = 0; i < 20'000; ++i) {
    const auto angles = falcon_angles(place(random));
    ASSERT_TRUE(angles);
    const auto pose = falcon_pose(*angles);
    ASSERT_TRUE(pose);
    most = std::max(most, Eigen::JacobiSVD<Matrix3d>(pose->jacobian).singularValues()[0]);
  }
  EXPECT_LT(most * falcon_count_step(), G::kResolution);
}

}  // namespace
}  // namespace reckon::haptics::falcon_kinematics_test
