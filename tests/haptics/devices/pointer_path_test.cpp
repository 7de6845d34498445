// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/devices/pointer_path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <vector>

#include "reckon/haptics/devices/pointer_inbox.hpp"
#include "reckon/tests/haptics/support/pointer_play.hpp"

namespace reckon::haptics {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

constexpr double kSpeed = 0.8;  // [m/s]

AlignedBox3d box(double half) {
  return {Vector3d::Constant(-half), Vector3d(Vector3d::Constant(half))};
}

// The path of one seed's samples, every 0.25 ms.
std::vector<Vector3d> played(unsigned seed, PointerPath& path) {
  constexpr int kPerMs = 4;
  PointerInbox inbox;
  PointerPlay play(seed);
  std::vector<Vector3d> points;
  for (int i = 0; i < 2000 * kPerMs; ++i) {
    if (i % kPerMs == 0) {
      play.at(i / kPerMs, [&](const PointerSample& sample) { inbox.put(sample); });
    }
    if (inbox.take() && inbox.sample().held) path.lead_to(inbox.sample().position);
    path.advance(1e-3 / kPerMs);
    points.push_back(path.position());
  }
  return points;
}

// From the positions only: no second difference changes by more than the bound of the jerk.
TEST(PointerPath, IsContinuousToTheSecondDerivative) {
  constexpr double h = 0.25e-3;
  constexpr double kRounding = 1e-6;  // of second differences: 1e-16 / h^2
  double fastest = 0, most_acceleration = 0, most_jerk = 0;
  for (unsigned seed = 1; seed <= 1000; ++seed) {
    PointerPath path(box(0.5), Vector3d::Zero(), kSpeed);
    const std::vector<Vector3d> p = played(seed, path);
    Vector3d last = Vector3d::Zero();
    for (std::size_t i = 1; i + 1 < p.size(); ++i) {
      const Vector3d second = (p[i + 1] - 2 * p[i] + p[i - 1]) / (h * h);
      fastest = std::max(fastest, (p[i] - p[i - 1]).norm() / h);
      most_acceleration = std::max(most_acceleration, second.norm());
      if (i > 1) most_jerk = std::max(most_jerk, (second - last).norm() / h);
      last = second;
      ASSERT_TRUE(path.box().contains(p[i])) << seed;
    }
    ASSERT_LE(fastest, kSpeed * (1 + 1e-9)) << seed;
    ASSERT_LE(most_acceleration, path.max_acceleration() + kRounding) << seed;
    ASSERT_LE(most_jerk, path.max_jerk() + kRounding / h) << seed;
  }
  std::printf("fastest %.3f m/s, %.2f m/s^2, %.0f m/s^3\n", fastest, most_acceleration, most_jerk);
  const PointerPath path(box(0.5), Vector3d::Zero(), kSpeed);
  EXPECT_GT(fastest, 0.9 * path.max_speed()) << "the bounds are not idle";
  EXPECT_GT(most_acceleration, 0.5 * path.max_acceleration());
  EXPECT_GT(most_jerk, 0.5 * path.max_jerk());
}

TEST(PointerPath, ReportsItsOwnDerivatives) {
  PointerPath path(box(1), Vector3d::Zero(), kSpeed);
  constexpr double h = 1e-4;
  for (int i = 0; i < 4000; ++i) {
    if (i % 170 == 0) path.lead_to({i % 340 == 0 ? 0.2 : -0.1, 1e-5 * i, 0.0});
    const Vector3d p = path.position(), v = path.velocity(), a = path.acceleration();
    path.advance(h);
    const Vector3d jerk_of_it = (path.acceleration() - a) / h;
    ASSERT_LE(jerk_of_it.norm(), path.max_jerk() * (1 + 1e-9));
    // The trapezoidal rule has an error of h^2/12 of the jerk, and of its changes.
    ASSERT_LE(((path.position() - p) / h - 0.5 * (v + path.velocity())).norm(),
              h * h / 12 * path.max_jerk() + 1e-10);
    ASSERT_LE(((path.velocity() - v) / h - 0.5 * (a + path.acceleration())).norm(),
              h / 4 * path.max_jerk());
  }
}

TEST(PointerPath, LagsByItsTimeConstantBehindSteadyMotion) {
  PointerPath path(box(10), Vector3d::Zero(), kSpeed);
  path.lead_to({10, 0, 0});  // the goal moves there at full speed
  for (int i = 0; i < 1000; ++i) path.advance(1e-3);
  EXPECT_NEAR(path.position().x(), kSpeed * (1.0 - PointerPath::kLag), 1e-12);
  EXPECT_NEAR(path.velocity().x(), kSpeed, 1e-12);
  EXPECT_NEAR(path.acceleration().x(), 0.0, 1e-9);
}

TEST(PointerPath, AnswersAJumpAsAThirdOrderFilter) {
  constexpr double kJump = 1e-3;
  PointerPath path(box(1), Vector3d::Zero(), 1e6);  // no effective speed limit
  path.lead_to({kJump, 0, 0});
  double t = 0, last = 0;
  for (int i = 0; i < 300; ++i) {
    path.advance(1e-3);
    t += 1e-3;
    const double x = PointerPath::kBandwidth * t;
    EXPECT_NEAR(path.position().x(), kJump * (1 - std::exp(-x) * (1 + x + x * x / 2)), 1e-9);
    EXPECT_GE(path.position().x(), last) << "no way back";
    last = path.position().x();
  }
}

TEST(PointerPath, IsIndependentOfTheStepLength) {
  PointerPath coarse(box(0.5), Vector3d::Zero(), kSpeed), fine = coarse;
  PointerPlay play(3), same(3);
  for (int ms = 0; ms < 2000; ++ms) {
    const auto lead = [](PointerPath& path) {
      return [&path](const PointerSample& sample) { path.lead_to(sample.position); };
    };
    play.at(ms, lead(coarse));
    same.at(ms, lead(fine));
    coarse.advance(1e-3);
    for (int i = 0; i < 10; ++i) fine.advance(1e-4);
    ASSERT_LE((coarse.position() - fine.position()).norm(), 1e-12) << ms;
  }
}

TEST(PointerPath, ComesToRestAtItsGoal) {
  PointerPath path(box(1), Vector3d::Zero(), kSpeed);
  path.lead_to({1, 0, 0});
  for (int i = 0; i < 500; ++i) path.advance(1e-3);
  path.rest();
  for (int i = 0; i < 500; ++i) path.advance(1e-3);
  EXPECT_NEAR(path.position().x(), 0.5 * kSpeed, 1e-12) << "where the wanted point was";
  EXPECT_NEAR(path.velocity().x(), 0.0, 1e-12);
}

TEST(PointerPath, RefusesInvalidBoxesAndSpeeds) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(PointerPath({}, Vector3d::Zero(), 1), std::invalid_argument);
  EXPECT_THROW(PointerPath(box(1), Vector3d::Constant(nan), 1), std::invalid_argument);
  EXPECT_THROW(PointerPath(box(1), Vector3d::Zero(), 0), std::invalid_argument);
  EXPECT_THROW(PointerPath(box(1), Vector3d::Zero(), nan), std::invalid_argument);
}

}  // namespace
}  // namespace reckon::haptics
