// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/velocity_trend.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace reckon::peer {
namespace {

using std::chrono::milliseconds;

constexpr double kRate = 80.0;  // [rad/s], of a hand that is thrown off an edge
constexpr double kMost = 10.0;  // [m/s^2]

struct Told {
  double off = 0.0;    // maximum error of the acceleration [m/s^2]
  double doubt = 0.0;  // maximum [m/s^2]
};

// A swing whose velocities have an error of `noise` [m/s], sampled every `period`.
Told swing(milliseconds period, double noise) {
  VelocityTrend trend;
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  Told most;
  for (milliseconds now(1000); now < milliseconds(2000); now += period) {
    const double phase = kRate * 1e-3 * static_cast<double>(now.count());
    const double velocity = kMost / kRate * std::sin(phase) + noise * normal(random);
    trend.note(now, velocity * Eigen::Vector3d::UnitX());
    if (now < milliseconds(1200)) continue;
    most.off = std::max(most.off, std::abs(trend.acceleration().x() - kMost * std::cos(phase)));
    most.doubt = std::max(most.doubt, trend.doubt());
  }
  return most;
}

TEST(VelocityTrend, FollowsASwingWithinAMillisecond) {
  for (const int period : {1, 2}) {
    const Told told = swing(milliseconds(period), 0.0);
    EXPECT_LT(told.off, kMost * kRate * 1.05e-3) << period << " ms";
    EXPECT_LT(told.doubt, 0.03 * kMost) << period << " ms";
  }
}

TEST(VelocityTrend, PredictsBetterThanAConstantAcceleration) {
  constexpr double kAhead = 0.004;  // [s]
  for (const int period : {1, 2}) {
    VelocityTrend trend;
    double stays = 0.0, comes = 0.0;
    for (int ms = 1000; ms < 2000; ms += period) {
      const double phase = kRate * 1e-3 * ms;
      trend.note(milliseconds(ms), kMost / kRate * std::sin(phase) * Eigen::Vector3d::UnitX());
      if (ms < 1200) continue;
      const double later = kMost * std::cos(phase + kRate * kAhead);
      stays = std::max(stays, std::abs(trend.acceleration().x() - later));
      comes = std::max(comes, std::abs(trend.acceleration_in(kAhead).x() - later));
    }
    EXPECT_LT(comes, 0.5 * stays) << period << " ms";
  }
}

TEST(VelocityTrend, DoubtIncludesNoise) {
  for (const int period : {1, 2}) {
    const Told told = swing(milliseconds(period), 0.007);
    EXPECT_GT(told.doubt, 10.0) << period << " ms";
    EXPECT_LT(told.off, told.doubt) << period << " ms";
  }
}

TEST(VelocityTrend, DoubtsABlow) {
  VelocityTrend trend;
  for (int ms = 1000; ms < 1100; ms += 2) trend.note(milliseconds(ms), Eigen::Vector3d::Zero());
  EXPECT_EQ(trend.doubt(), 0.0);
  trend.note(milliseconds(1100), 0.2 * Eigen::Vector3d::UnitX());
  EXPECT_GE(trend.doubt(), trend.acceleration().norm());
}

TEST(VelocityTrend, IsZeroForRareVelocities) {
  VelocityTrend trend;
  for (int ms = 1000; ms < 1100; ms += 5)
    trend.note(milliseconds(ms), 0.01 * ms * Eigen::Vector3d::UnitX());
  EXPECT_TRUE(trend.acceleration().isZero(0));
}

}  // namespace
}  // namespace reckon::peer
