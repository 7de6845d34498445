// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The judge of touch: the cases that it rejects, and the cases that it accepts.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "reckon/tests/fuzz/touch/hand.hpp"
#include "reckon/tests/fuzz/touch/power.hpp"
#include "reckon/tests/fuzz/touch/rest.hpp"

namespace reckon::fuzz {
namespace {

TEST(TouchJudge, CallsForcesWrongBeyondBothTolerances) {
  EXPECT_FALSE((Rest{1.0, 0.81, false}.is_wrong()));
  EXPECT_TRUE((Rest{1.0, 0.79, false}.is_wrong()));
  EXPECT_TRUE((Rest{1.0, 1.21, false}.is_wrong()));
  EXPECT_FALSE((Rest{0.3, 0.21, false}.is_wrong()));
  EXPECT_TRUE((Rest{0.0, 0.11, false}.is_wrong()));
}

TEST(TouchJudge, WantsNineTenthsBackAfterAnInterruption) {
  EXPECT_FALSE((Rest{1.0, 0.89, false}.is_wrong()));
  EXPECT_TRUE((Rest{1.0, 0.89, true}.is_wrong()));
  EXPECT_FALSE((Rest{1.0, 0.91, true}.is_wrong()));
  EXPECT_FALSE((Rest{0.3, 0.26, true}.is_wrong()));
  EXPECT_NEAR((Rest{2.0, 0.5, true}.lacks()), 0.75, 1e-12);
}

// Springs in series: 1/(1/300 + 1/500 + 1/300) of 20 mm, and 1/(1/300 + 1/1400) of 15 mm.
TEST(TouchJudge, ExpectsSeriesSpringsForHandsAndWalls) {
  const std::vector<Shows> stiff(2, {1e4, 1e4}), soft(2, {1e4, 700}), other = {{1e4, 0}, {400, 0}};
  Scenario pair = scenario_of("press1=0.02");
  EXPECT_NEAR(right_forces(pair, stiff, 5)[0], 20e-3 / (2 / 300.0 + 1 / 500.0), 1e-3);
  EXPECT_NEAR(right_forces(pair, other, 5)[1], 20e-3 / (2 / 300.0 + 1 / 400.0), 1e-3);
  Scenario wall = scenario_of("press1=-0.02 wall=1400 wall_gap=0.005");
  EXPECT_NEAR(right_forces(wall, stiff, 5)[0], 15e-3 / (1 / 300.0 + 1 / 1400.0), 1e-9);
  EXPECT_NEAR(right_forces(wall, soft, 5)[0], 15e-3 / (1 / 300.0 + 1 / 700.0), 1e-9);
  EXPECT_EQ(right_forces(wall, stiff, 5)[1], 0.0);
}

// 100 N/m against a grip of 300, 15 mm away; 0.2 N along each axis; 300 N/m from 30 mm on.
TEST(TouchJudge, ExpectsTheForceOfARegion) {
  std::vector<Shows> shows(2, {1e4, 1e4});
  const auto force = [&](const char* line) {
    const Scenario scenario = scenario_of(std::string("press2=0.01 ") + line);
    EXPECT_TRUE(is_promised(scenario)) << line;
    return right_forces(scenario, shows, 5)[0];
  };
  EXPECT_NEAR(force("region=4 region_off=0.015"), 0.015 / (1 / 100.0 + 1 / 300.0), 1e-6);
  EXPECT_NEAR(force("region=3"), std::sqrt(3.0) * 0.2, 1e-9);
  EXPECT_NEAR(force("region=7 region_off=0.034"), 0.004 / (2 / 300.0), 1e-6);
  shows.assign(2, {1e4, 1e4, 50});
  EXPECT_NEAR(force("region=4 region_off=0.015"), 0.015 / (1 / 50.0 + 1 / 300.0), 1e-6);
  EXPECT_EQ(force("region=5"), 0.0);                                    // in the middle of a magnet
  EXPECT_FALSE(is_promised(scenario_of("region=4 region_off=0.015")));  // beside another hand
  EXPECT_FALSE(is_promised(scenario_of("press2=0.01 region=4 region_off=0.029")));
  EXPECT_FALSE(is_promised(scenario_of("press2=0.01 region=1")));
}

TEST(TouchJudge, WaitsUntilAllIsOver) {
  EXPECT_NEAR(still_since(scenario_of("press1=0.02 begin1=0.3 rise1=1")), 1.3, 1e-12);
  EXPECT_NEAR(still_since(scenario_of("off_hand=1 off_at=2 off_for=0.5")), 2.5, 1e-12);
  EXPECT_NEAR(still_since(scenario_of("failed=0.001 calm_after=3")), 3, 1e-12);
  EXPECT_NEAR(still_since(scenario_of("silent_hand=2 silent_at=1 silent_for=2")), 3, 1e-12);
  EXPECT_NEAR(still_since(scenario_of("unknown_hand=1 unknown_until=2")), 2, 1e-12);
  EXPECT_NEAR(still_since(scenario_of("model=1 fault=8 fault_at=1 fault_for=0.5")), 2.5, 1e-12);
  EXPECT_NEAR(still_since(scenario_of("model=2 fault=8 fault_at=1 fault_for=0.5")), 6.5, 1e-12);
  EXPECT_TRUE(std::isinf(still_since(scenario_of("amplitude1=0.01"))));
}

TEST(TouchJudge, PromisesNothingOverBadLinesOrForLiars) {
  EXPECT_TRUE(is_promised(scenario_of("press1=0.02 delay=0.05 device_delay=3 servo_rate=250")));
  EXPECT_FALSE(is_promised(scenario_of("delay=0.05 jitter=0.1")));
  EXPECT_FALSE(is_promised(scenario_of("loss=0.01")));
  EXPECT_FALSE(is_promised(scenario_of("liar=1")));
  EXPECT_FALSE(is_promised(scenario_of("hands=3")));
  EXPECT_FALSE(is_promised(scenario_of("press1=0.01 wall=500")));  // at the other hand too
  EXPECT_TRUE(is_promised(scenario_of("press1=-0.01 wall=500")));
  EXPECT_TRUE(is_promised(scenario_of("model=1 press1=0.02")));
  EXPECT_FALSE(is_promised(scenario_of("model=1 press1=0.03")));  // may be out of its reach
  EXPECT_FALSE(is_promised(scenario_of("model=4 press1=0.02")));  // hands are not uploaded ahead
  EXPECT_TRUE(is_promised(scenario_of("model=4 press1=-0.03 wall=500 wall_gap=0.02")));
  EXPECT_FALSE(is_promised(scenario_of("model=4 press1=-0.03 wall=500 wall_gap=0.01")));
  EXPECT_FALSE(is_promised(scenario_of("press1=0.02 press2=-0.02")));  // might change sides
}

// 2 W for 0.5 s are 1 W over a second, and 100 mJ in any 50 ms.
TEST(TouchJudge, MeasuresALiarBesideItsTwin) {
  std::vector<double> nobody(3000, 0.0), liar(3000, 0.0);
  for (std::size_t i = 1; i < liar.size(); ++i) {
    liar[i] = liar[i - 1] + (i > 1000 && i <= 1500 ? 2e-3 : 0.0);
  }
  EXPECT_NEAR(excess_over(liar, nobody).power, 1.0, 1e-9);
  EXPECT_NEAR(excess_over(liar, nobody).burst, 0.1, 1e-9);
  std::vector<double> later(3000, 0.0);
  for (std::size_t i = 50; i < later.size(); ++i) later[i] = liar[i - 50];
  EXPECT_NEAR(excess_over(liar, later).power, 0.0, 1e-9);
  EXPECT_NEAR(excess_over(liar, later).burst, 0.0, 1e-9);
  for (double& energy : later) energy *= 0.5;  // half of it is below the allowance
  EXPECT_NEAR(excess_over(liar, later).power, 0.25, 1e-9);
}

TEST(TouchJudge, LeadsATwinNoFasterThanAnArm) {
  Track track;
  track.points = {{0, 0, 0}, {0.1, 0, 0}, {0.1, 0, 0}, {0.1, 0, 0}};
  track.slow_down(1.5);
  EXPECT_NEAR(track.at(2e-3).position.x(), 3e-3, 1e-12);
  EXPECT_NEAR(track.at(0.5e-3).velocity.x(), 1.5, 1e-9);
  EXPECT_NEAR(track.at(9).position.x(), 4.5e-3, 1e-12);
  EXPECT_EQ(track.at(9).velocity.x(), 0.0);
}

}  // namespace
}  // namespace reckon::fuzz
