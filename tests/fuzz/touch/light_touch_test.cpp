// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Heavy hands on stiff grips that hardly touch, with coarse encoders over a slow line: they part,
// meet again, and must come to rest. Also touches through device models.
#include <gtest/gtest.h>

#include <string>

#include "reckon/tests/fuzz/touch/trial.hpp"

namespace reckon::fuzz {
namespace {

constexpr double kSeconds = 6.6;

class LightTouch : public ::testing::TestWithParam<double> {};

// 9.95 mm, starting inside by half an encoder step: 3 Hz, 0.7 N instead of 0.04 N if a loan pays
// for it.
TEST_P(LightTouch, DoesNotRingOnALoan) {
  for (const double rate : {0.0, 50.0, 100.0}) {
    for (const double press : {0.0049, 0.005157, 0.0055, 0.007}) {
      Scenario scenario = scenario_of("seed=121786 grip=600 mass=0.6682 damping=2.057");
      scenario[Shared::rate] = rate;
      scenario[Shared::encoder] = GetParam();
      scenario.path(0, Path::press) = press;
      scenario.path(1, Path::press) = 0.004923;
      const Outcome outcome = try_out(scenario, kSeconds);
      EXPECT_TRUE(outcome.violation.empty()) << outcome.violation << ", " << line_of(scenario);
      EXPECT_TRUE(outcome.told || outcome.wrong_force.empty())
          << outcome.wrong_force << ", " << line_of(scenario);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Encoders, LightTouch,
                         ::testing::Values(0.0, 1e-6, 1e-5, 3e-5, 5e-5, 8.189e-5, 1e-4));

// Springs in series, 1/(1/300 + 1/100) of 13 mm = 0.975 N, which all four can show.
TEST(ModelTouch, EachModelShowsAWallWithoutMakingEnergy) {
  for (const char* model : {"model=1", "model=2", "model=3", "model=4"}) {
    const Scenario scenario = scenario_of(std::string("press1=-0.03 wall=100 wall_gap=0.02 "
                                                      "model_damping=6 ") +
                                          model);
    const Outcome outcome = try_out(scenario, 4.8);
    EXPECT_EQ(outcome.violation, "") << model;
    EXPECT_EQ(outcome.wrong_force, "") << model;
    EXPECT_LT(outcome.wrong, 0.05) << model;
    EXPECT_LT(outcome.model.made, 1e-9) << model;
    EXPECT_GT(outcome.model.left, 0) << model;
    EXPECT_LT(outcome.model.claimed, 1e-9) << model;
  }
}

// In and out of walls, beside another hand, with faults.
TEST(ModelTouch, RunsRepeatAndKeepTheirBooks) {
  for (const char* model :
       {"model=1 fault=1", "model=2 fault=6", "model=3 fault=8", "model=4 fault=4"}) {
    const Scenario scenario = scenario_of(
        std::string("seed=5 press1=0.01 amplitude1=0.02 wall=800 wall_gap=0.004 begin1=0 rise1=0.1 "
                    "model_damping=6 grip=600 fault_at=0.4 fault_for=0.01 fault_every=0.5 ") +
        model);
    const Outcome one = try_out(scenario, 1.5), again = try_out(scenario, 1.5);
    EXPECT_EQ(one.violation, "") << model;
    EXPECT_GT(one.model.left, 0) << model;
    EXPECT_LT(one.model.left, 1) << model << ": nothing is felt";
    EXPECT_EQ(one.model.made, again.model.made) << model;
    EXPECT_EQ(one.model.left, again.model.left) << model;
    EXPECT_EQ(one.excess, again.excess) << model;
  }
}

}  // namespace
}  // namespace reckon::fuzz
