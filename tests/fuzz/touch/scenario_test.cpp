// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A scenario that was found can be restored from its line.
#include "reckon/tests/fuzz/touch/scenario.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "reckon/tests/fuzz/touch/rest.hpp"
#include "reckon/tests/fuzz/touch/trial.hpp"

namespace reckon::fuzz {
namespace {

using testing::HasSubstr;

TEST(TouchScenario, IsRestoredExactlyFromItsLine) {
  Random random(7);
  for (int i = 0; i < 1000; ++i) {
    Scenario scenario = any_scenario(random);
    for (int step = 0; step < 5; ++step) {
      EXPECT_EQ(scenario_of(line_of(scenario)), scenario) << line_of(scenario);
      scenario = neighbour(scenario, random);
    }
  }
}

TEST(TouchScenario, WritesOnlyChangedValues) {
  EXPECT_EQ(line_of(Scenario()), "seed=1");
  Scenario scenario;
  scenario.seed = 12;
  scenario[Shared::delay] = 0.02;
  scenario.path(1, Path::press) = -0.01;
  EXPECT_EQ(line_of(scenario), "seed=12 delay=0.02 press2=-0.01");
}

TEST(TouchScenario, StaysInRangeWhereverTheSearchGoes) {
  Random random(8);
  Scenario scenario = any_scenario(random);
  for (int i = 0; i < 10'000; ++i) {
    scenario = neighbour(scenario, random);
    for (std::size_t gene = 0; gene < kGenes; ++gene) {
      ASSERT_GE(scenario.values[gene], genes()[gene].low) << genes()[gene].name;
      ASSERT_LE(scenario.values[gene], genes()[gene].high) << genes()[gene].name;
    }
  }
}

TEST(TouchScenario, NamesTheWordThatIsWrong) {
  const auto words_of = [](const std::string& line) -> std::string {
    try {
      return line_of(scenario_of(line)) + " taken";
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
  };
  EXPECT_THAT(words_of("seed=1 delya=0.02"), HasSubstr("'delya=0.02'"));
  EXPECT_THAT(words_of("delay"), HasSubstr("NAME=NUMBER"));
  EXPECT_THAT(words_of("delay=fast"), HasSubstr("a number is needed"));
  EXPECT_THAT(words_of("delay=9"), HasSubstr("0 to 0.5"));
  EXPECT_THAT(words_of("delay=nan"), HasSubstr("0 to 0.5"));
  EXPECT_THAT(words_of("hands=2.5"), HasSubstr("a whole number"));
  EXPECT_THAT(words_of("seed=-1"), HasSubstr("a whole number"));
}

TEST(TouchScenario, RunsTheSameEachTime) {
  Random random(9);
  const Scenario scenario = any_scenario(random);
  const Outcome one = try_out(scenario, 1), again = try_out(scenario, 1);
  EXPECT_EQ(one.least_held, again.least_held);
  EXPECT_EQ(one.excess, again.excess);
  EXPECT_EQ(one.meter, again.meter);
}

// Springs in series, 1/(1/300 + 1/500 + 1/300) of 20 mm = 2.31 N.
TEST(TouchScenario, FindsAnHonestSlowPressRight) {
  const Outcome outcome = try_out(scenario_of("press1=0.02 rise1=1"), 6);
  EXPECT_LT(outcome.wrong, 0.03);
  EXPECT_EQ(outcome.violation, "");
}

TEST(TouchScenario, SlowPressIsRightForUnlikeDevices) {
  for (const char* devices : {"servo_rate=250 device_delay=1", "servo_rate=4000 device_delay=4",
                              "servo_rate=2000 other_hand=2 other_rate=500 other_delay=1"}) {
    const Outcome outcome = try_out(scenario_of(std::string("press1=0.02 ") + devices), 6);
    EXPECT_LT(outcome.wrong, 0.03) << devices;
    EXPECT_EQ(outcome.wrong_force, "") << devices;
  }
}

// A hand that was never received is not felt; one that was silent is felt again.
TEST(TouchScenario, KeepsQuietAboutAHand) {
  EXPECT_GT(try_out(scenario_of("press1=0.02 unknown_hand=2 unknown_until=3"), 3).rows, 0.9);
  EXPECT_GT(try_out(scenario_of("press1=0.02 silent_hand=2 silent_at=0 silent_for=3"), 3).rows,
            0.99);
  EXPECT_LT(try_out(scenario_of("press1=0.02 silent_hand=2 silent_at=1 silent_for=2"), 7).lacks,
            0.1);
}

TEST(TouchScenario, HandsTouchTheSolidsBesideThem) {
  for (const char* solid : {"solid=1", "solid=2", "solid=3", "solid=4"}) {
    const std::string line = "press1=-0.03 solid_stiffness=1000 solid_gap=0.002 ";
    EXPECT_LT(try_out(scenario_of(line + solid), 2).least_held, 1) << solid;
  }
  EXPECT_EQ(try_out(scenario_of("press1=-0.03"), 2).least_held, Outcome().least_held);
}

// A body falls on the hand; a heavy one falls past it, and another lies on a floor.
TEST(TouchScenario, LetsBodiesFallOnAHand) {
  for (const char* body : {"body=1 body_mass=0.1", "body=2 body_mass=0.3 body_beside=0.002",
                           "body=1 body_mass=5 body_floor=0.1"}) {
    const Outcome outcome = try_out(scenario_of(body), 2);
    EXPECT_GT(outcome.pushed, 0.01) << body << " is not felt";
    EXPECT_LE(outcome.haunted, 0.05) << body;
    EXPECT_EQ(outcome.violation, "") << body;
  }
}

TEST(TouchScenario, PinchesACubeBesideAHeap) {
  const Outcome outcome =
      try_beside_heap(scenario_of("paddle=0.5 pile=20 body=1 body_mass=0.1"), 2);
  EXPECT_GT(outcome.pinched, 0.9);
  EXPECT_LT(outcome.pinched, 1.2);
  EXPECT_LE(outcome.heap_force, 1e-3);
  EXPECT_LE(outcome.heap_place, 1e-6);
}

// A late servo steps the bodies once more, for a short time.
TEST(TouchScenario, PinchesACubeBesideAHeapWhileLate) {
  const Outcome outcome =
      try_beside_heap(scenario_of("seed=184982 late=0.03435 body=1 pile=2 paddle=0.7413"), 2);
  EXPECT_LE(outcome.heap_place, 1e-6);
}

// Weight, spring, magnet and border; the judge computes their force independently.
TEST(TouchScenario, RegionForceIsRightAtRest) {
  for (const char* region : {"region=3 region_strength=0.9", "region=4 region_off=0.015",
                             "region=5 region_off=0.01", "region=7 region_off=0.036"}) {
    const Scenario scenario = scenario_of(std::string("press2=0.01 ") + region);
    EXPECT_TRUE(is_promised(scenario)) << region;
    const Outcome outcome = try_out(scenario, 5);
    EXPECT_LT(outcome.wrong, 0.02) << region;
    EXPECT_FALSE(outcome.told) << region;
  }
}

}  // namespace
}  // namespace reckon::fuzz
