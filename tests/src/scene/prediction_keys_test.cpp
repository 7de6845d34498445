// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The sections of a scene file on prediction: [dead_reckoning] and [convergence].
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/peer/scene/scene_words.hpp"
#include "reckon/tests/src/support/refusal.hpp"

namespace reckon::peer::prediction_keys_test {
namespace {

using test::refusal;
using testing::HasSubstr;

std::uint64_t hash_of(const std::string& text) { return parse_scene_file(text, "x.toml").hash; }

TEST(PredictionKeys, AreRefusedWithPlaceAndNearestWord) {
  struct Case {
    std::string text, words;
  };
  const Case cases[] = {
      {"[dead_reckoning]\nalgorithm = \"rvv\"\n", "(did you mean \"rvw\"?)"},
      {"[dead_reckoning]\nrule = \"true_distanse\"\n", "(did you mean \"true_distance\"?)"},
      {"[dead_reckoning]\nrule = \"per_axes\"\n",
       "one of true_distance per_axis velocity_aware seen_from"},
      {"[dead_reckoning]\nrule = \"true_distance per_axis\"\n",
       "x.toml:2:8: 'rule' is \"true_distance per_axis\""},
      {"[dead_reckoning]\nspeed_allowence = 1\n", "(did you mean 'speed_allowance'?)"},
      {"[dead_reckoning]\nspeed_allowance = \"50 ms\"\n",
       "'speed_allowance' needs the rule 'velocity_aware'"},
      {"[dead_reckoning]\nviewer_distance = 3\nrule = \"per_axis\"\n",
       "x.toml:2:19: 'viewer_distance' needs the rule 'seen_from'"},
      {"[dead_reckoning]\nrule = \"seen_from\"\n",
       "x.toml:2:8: rule 'seen_from' needs 'viewer_distance' above 0"},
      {"[dead_reckoning]\nforce_share = \"110 %\"\n", "it must be 0 to 1"},
      {"[dead_reckoning]\nacceleration = \"inertia\"\n", "(did you mean \"inertial\"?)"},
      {"[convergence]\ncurve = \"cubik\"\n", "(did you mean \"cubic\"?)"},
      {"[convergense]\ncurve = \"cubic\"\n", "(did you mean 'convergence'?)"},
      {"[convergence]\nduration = \"10 s\"\n", "it must be 20 ms to 2 s"},
      {"[convergence]\nprediction = \"adaptative\"\n", "(did you mean \"adaptive\"?)"},
  };
  for (const auto& [text, words] : cases) EXPECT_THAT(refusal(text), HasSubstr(words)) << text;
}

// Peers of earlier versions and scenes without these keys must have the same hash.
TEST(SceneHash, IsIndependentOfDefaultAccelerationReadingAndConvergence) {
  const std::string object = "[[object]]\nname = \"a\"\nsphere = \"50 mm\"\n";
  EXPECT_EQ(hash_of(object), hash_of(object + "[dead_reckoning]\nacceleration = \"component\"\n"
                                              "rule = \"per_axis\"\nforce_share = 0.1\n"
                                              "[convergence]\ncurve = \"linear\"\n"));
  EXPECT_EQ(hash_of(""), 0x9b74aa729063af23ULL);
}

TEST(PredictionKeys, GivesTheRuleTheReadingAndTheConvergence) {
  const SceneFile file = parse_scene_file(
      "[dead_reckoning]\nalgorithm = \"auto\"\nrule = \"velocity_aware\"\n"
      "speed_allowance = \"50 ms\"\nforce_share = \"10 %\"\nacceleration = \"inertial\"\n"
      "[convergence]\ncurve = \"quintic\"\nduration = \"80 ms\"\n"
      "longest = \"300 ms\"\nteleport_distance = \"30 cm\"\nteleport_angle = 1.5\nprediction = "
      "\"adaptive\"\n",
      "x.toml");
  EXPECT_EQ(file.dead_reckoning.algorithm, std::nullopt);
  EXPECT_EQ(file.dead_reckoning.rule->name, "velocity_aware");
  EXPECT_EQ(file.dead_reckoning.thresholds.of<deadreckon::VelocityAware>().speed_allowance, 0.05);
  EXPECT_EQ(file.dead_reckoning.thresholds.weber, 0.1);
  EXPECT_EQ(file.dead_reckoning.acceleration, deadreckon::AccelerationReading::inertial);
  EXPECT_EQ(file.convergence.settings.curve, deadreckon::ConvergenceCurve::quintic);
  EXPECT_EQ(file.convergence.settings.duration, 0.08);
  EXPECT_EQ(file.convergence.settings.longest, 0.3);
  EXPECT_EQ(file.convergence.settings.teleport_distance, 0.3);
  EXPECT_EQ(file.convergence.settings.teleport_angle, 1.5);
  EXPECT_EQ(file.convergence.prediction, Prediction::adaptive);
}

TEST(PredictionKeys, TakesEveryRuleCurveAndModel) {
  deadreckon::for_each_send_rule([]<class Rule>(std::type_identity<Rule>) {
    std::string text = fmt::format("[dead_reckoning]\nrule = \"{}\"\n", Rule::kName);
    for (const auto& row : Rule::kParameters)
      text += fmt::format("{} = {}\n", row.key, row.maximum);
    const SceneFile file = parse_scene_file(text, "x.toml");
    EXPECT_EQ(file.dead_reckoning.rule->name, Rule::kName);
    for (const auto& row : Rule::kParameters)
      EXPECT_EQ(file.dead_reckoning.thresholds.of<Rule>().*row.field, row.maximum) << row.key;
  });
  for (const auto& row : deadreckon::kConvergenceCurves) {
    const SceneFile file =
        parse_scene_file(fmt::format("[convergence]\ncurve = \"{}\"\n", row.name), "x.toml");
    EXPECT_EQ(file.convergence.settings.curve, row.curve);
  }
  for (int number = 1; number <= 9; ++number) {
    const std::optional algorithm = static_cast<pdu::DeadReckoningAlgorithm>(number);
    const SceneFile file = parse_scene_file(
        fmt::format("[dead_reckoning]\nalgorithm = \"{}\"\n", word_of(algorithm)), "x.toml");
    EXPECT_EQ(file.dead_reckoning.algorithm, algorithm);
  }
  EXPECT_EQ(word_of(DeadReckoningConfig{}.algorithm), "auto");
}

}  // namespace
}  // namespace reckon::peer::prediction_keys_test
