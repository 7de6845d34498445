// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/contact/surface_tracker.hpp"

#include <gtest/gtest.h>

namespace reckon::haptics {
namespace {

constexpr Following kPair{true, 500.0};

// For updates of this age [s], interval [s] and error [m].
SurfaceTracker learnt(double age, double interval, double miss) {
  SurfaceTracker tracker;
  for (int i = 0; i < 100; ++i) tracker.learn(age, interval, miss);
  return tracker;
}

TEST(SurfaceTracker, FollowsAPairCloselyOnAShortLine) {
  const SurfaceTracker tracker = learnt(0.001, 0.004, 3e-5);
  EXPECT_NEAR(tracker.time_constant(kPair), 0.003, 1e-9);
  EXPECT_NEAR(tracker.time_constant({false, 500.0}), 2 * 0.005, 1e-9);
}

TEST(SurfaceTracker, FollowsSlowlyIfDelayOutweighsDamping) {
  const SurfaceTracker tracker = learnt(0.006, 0.004, 3e-5);
  EXPECT_LT(tracker.time_constant({true, 700.0}), 0.012);
  EXPECT_NEAR(tracker.time_constant({true, 800.0}), 2 * 0.010, 1e-9);
}

TEST(SurfaceTracker, FollowsRowsSlowlyOnShortLines) {
  Following row{false, 550.0};
  row.in_row = true;
  EXPECT_NEAR(learnt(0.0, 0.002, 3e-5).time_constant(row), 0.05, 1e-9);
  EXPECT_NEAR(learnt(0.02, 0.01, 3e-5).time_constant(row), 2 * 0.03, 1e-9);
  row.stiffness = 1e9;
  EXPECT_NEAR(learnt(0.0, 0.002, 3e-5).time_constant(row), 0.1, 1e-9);
}

TEST(SurfaceTracker, FollowsCoarseUpdatesSlowly) {
  EXPECT_NEAR(learnt(0.001, 0.008, 1e-4).time_constant(kPair), 0.005, 1e-9);
  // But never more slowly than for a hand in a row.
  EXPECT_NEAR(learnt(0.001, 0.008, 1e-2).time_constant(kPair), 2 * 0.009, 1e-9);
}

TEST(SurfaceTracker, HasNoLagBehindASteadyMotion) {
  SurfaceTracker tracker = learnt(0.001, 0.004, 3e-5);
  const Eigen::Vector3d velocity(0.05, 0, 0);
  Eigen::Vector3d shown = Eigen::Vector3d::Zero();
  for (int step = 1; step <= 1000; ++step) {
    const double now = 1e-3 * step;
    shown = tracker.follow(velocity * (now - 1e-3), velocity * now, shown, 1e-3, kPair);
  }
  EXPECT_NEAR(shown.x(), 0.05, 1e-6);
}

}  // namespace
}  // namespace reckon::haptics
