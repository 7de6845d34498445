// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Heavy hands on stiff grips that hardly touch, with coarse encoders over a slow line: they part
// and meet again, and must come to rest.
#include <gtest/gtest.h>

#include "reckon/tests/fuzz/touch/trial.hpp"

namespace reckon::fuzz {
namespace {

constexpr double kSeconds = 6.6;

class LightTouch : public ::testing::TestWithParam<double> {};

// 9.95 mm and a start inside by half a step of the encoder; 3 Hz, 0.7 N in place of 0.04 N where a
// loan pays for it.
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

}  // namespace
}  // namespace reckon::fuzz
