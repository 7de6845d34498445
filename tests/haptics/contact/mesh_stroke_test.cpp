// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/contact/mesh_stroke.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;

const Vector3d kUp(0, 0, 1);

/// Turned from kUp towards x.
Vector3d turned(double angle) { return {std::sin(angle), 0, std::cos(angle)}; }

TEST(MeshStroke, FollowsTheContactPointOnATriangle) {
  MeshStroke stroke;
  for (int i = 0; i < 10; ++i) {
    const Vector3d scp(1e-4 * i, 2e-4 * i, 0);
    stroke.follow(scp, scp - 0.001 * kUp, kUp, 7, i == 0);
    EXPECT_EQ(stroke.place(), scp);
    EXPECT_EQ(stroke.normal(), kUp);
  }
}

// 0.1 mm and 0.05 rad at an edge, while the hand moves by 10 microns a sample.
TEST(MeshStroke, SmoothsAnEdgeAndConverges) {
  MeshStroke stroke;
  const auto step = [&](int i, double jump, double angle, std::uint32_t triangle) {
    const Vector3d at(1e-5 * i, 0, 0);
    const Vector3d before = stroke.place();
    stroke.follow(at + jump * Vector3d(std::cos(angle), 0, -std::sin(angle)), at - 0.001 * kUp,
                  turned(angle), triangle, i == 0);
    return (stroke.place() - before).norm();
  };
  step(0, 0, 0, 1);
  step(1, 0, 0, 1);
  EXPECT_NEAR(step(2, 1e-4, 0.05, 2), 1e-5, 1.1e-6) << "the hand's own way, and a tenth of it";
  EXPECT_NEAR(stroke.normal().x(), 0.005, 1e-4) << "half a radian for each millimetre";
  for (int i = 3; i < 150; ++i) EXPECT_LE(step(i, 1e-4, 0.05, 2), 1.11e-5);
  EXPECT_LT(
      (stroke.place() - Vector3d(149e-5 + 1e-4 * std::cos(0.05), 0, -1e-4 * std::sin(0.05))).norm(),
      1e-12);
  EXPECT_LT((stroke.normal() - turned(0.05)).norm(), 1e-12);
}

TEST(MeshStroke, FollowsASharpEdgeAtOnce) {
  MeshStroke stroke;
  stroke.follow(Vector3d::Zero(), -0.001 * kUp, kUp, 1, true);
  stroke.follow(Vector3d(0.002, 0, -0.002), -0.001 * kUp, turned(1.5), 2, false);
  EXPECT_EQ(stroke.place(), Vector3d(0.002, 0, -0.002));
  EXPECT_EQ(stroke.normal(), turned(1.5));
}

TEST(MeshStroke, RestartsWithEachContact) {
  MeshStroke stroke;
  stroke.follow(Vector3d::Zero(), -0.001 * kUp, kUp, 1, true);
  stroke.follow(Vector3d(1e-4, 0, 0), -0.001 * kUp, turned(0.1), 2, false);
  EXPECT_NE(stroke.place(), Vector3d(1e-4, 0, 0));
  stroke.follow(Vector3d(0.03, 0, 0), Vector3d(0.03, 0, -1e-5), turned(0.1), 3, true);
  EXPECT_EQ(stroke.place(), Vector3d(0.03, 0, 0));
  EXPECT_EQ(stroke.normal(), turned(0.1));
}

}  // namespace
}  // namespace reckon::haptics
