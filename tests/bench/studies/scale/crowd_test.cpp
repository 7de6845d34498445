// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Positions and motion of the entities of an exercise.
#include "reckon/bench/studies/scale/crowd.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <vector>

#include "reckon/tools/command_line/console.hpp"

namespace reckon::bench {
namespace {

using ::testing::HasSubstr;

TEST(Crowd, KeepsItsDensityAndItsSpeed) {
  Crowd crowd({"vehicles", 400, 100, 7});
  EXPECT_NEAR(crowd.side(), 2000, 1e-9);
  std::vector<aoim::Position> before;
  for (std::size_t i = 0; i < crowd.size(); ++i) before.push_back(crowd.position(i));
  double moved = 0;
  for (int tick = 1; tick <= 600; ++tick) {
    crowd.advance(0.1 * tick);
    for (std::size_t i = 0; i < crowd.size(); ++i) {
      const aoim::Position& at = crowd.position(i);
      ASSERT_TRUE(std::abs(at.x) <= 1000 && std::abs(at.y) <= 1000) << i;
      ASSERT_LE(distance(at, before[i]), 0.1 * 14 + 1e-9) << i;
      moved += distance(at, before[i]);
      before[i] = at;
    }
  }
  EXPECT_GT(moved / 400 / 60, 4);  // [m/s], on average
}

TEST(Crowd, HasTheRatesOfItsMotion) {
  constexpr double kStep = 1e-4;
  for (const Gait& gait : kGaits) {
    Crowd crowd({gait.name, 60, 100, 3});
    int compared = 0;
    for (double time = 1; time < 9; time += 0.5) {
      crowd.advance(time);
      std::vector<deadreckon::MotionSample> before;
      for (std::size_t i = 0; i < crowd.size(); ++i) before.push_back(crowd.motion(i));
      crowd.advance(time + kStep);
      for (std::size_t i = 0; i < crowd.size(); ++i) {
        const deadreckon::MotionSample after = crowd.motion(i);
        // A leg began, or an edge reflected the entity.
        if ((after.velocity - before[i].velocity).norm() > 40 * kStep) continue;
        ++compared;
        const Eigen::Vector3d seen = (after.position - before[i].position) / kStep;
        EXPECT_LT((seen - before[i].velocity).norm(), 1e-2) << gait.name << i;
        const Eigen::Vector3d rate = (after.velocity - before[i].velocity) / kStep;
        const bool stopped = before[i].velocity.norm() < 0.01;
        EXPECT_TRUE(stopped || (rate - before[i].acceleration).norm() < 0.05) << gait.name << i;
        // Body z points down.
        EXPECT_LT(
            (before[i].orientation * Eigen::Vector3d::UnitZ() + Eigen::Vector3d::UnitZ()).norm(),
            1e-9);
      }
    }
    EXPECT_GT(compared, 600) << gait.name;
  }
}

TEST(Crowd, RefusesUnknownMovements) {
  try {
    Crowd crowd({"swimmers", 10, 100, 1});
    FAIL();
  } catch (const tools::UsageError& error) {
    EXPECT_THAT(error.what(), HasSubstr("swimmers"));
    EXPECT_THAT(error.what(), HasSubstr("walkers"));
  }
}

}  // namespace
}  // namespace reckon::bench
