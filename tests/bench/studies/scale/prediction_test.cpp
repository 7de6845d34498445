// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Costs of live peers, drawn exercises and the pick of a policy.
#include "reckon/bench/studies/scale/prediction.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <random>

#include "reckon/bench/studies/scale/live_costs.hpp"
#include "reckon/bench/studies/scale/pick.hpp"
#include "reckon/peer/peer_threads.hpp"

namespace reckon::bench::prediction_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

constexpr LiveCosts kTrue{40e-6, 12e-6, 2e-6, 25e-6, 9e-6, 60e-6};

/// Samples whose counts are drawn, so that they tell the costs apart.
std::vector<CostSample> samples_of(const LiveCosts& costs, std::size_t count) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> draw(10, 1000);
  std::vector<CostSample> samples(count);
  for (CostSample& sample : samples) {
    for (double& times : sample.counts) times = draw(random);
    sample.cpu = 0;
    for (std::size_t i = 0; i < costs.size(); ++i) sample.cpu += sample.counts[i] * costs[i];
  }
  return samples;
}

TEST(LiveCosts, FitPredictsSamplesThatItHasNotSeen) {
  const std::vector<CostSample> samples = samples_of(kTrue, 40);
  const LiveCosts costs = fitted_costs(std::span(samples).first(30));
  for (const CostSample& unseen : std::span(samples).last(10))
    EXPECT_NEAR(live_cpu(unseen.counts, costs) / unseen.cpu, 1, 0.1);
}

TEST(LiveCosts, AreNeverBelowZero) {
  std::vector<CostSample> samples = samples_of({40e-6, 0, 0, 0, 0, 0}, 20);
  // The more datagrams, the less time.
  for (CostSample& sample : samples) sample.cpu /= 1 + 1e-3 * sample.counts[2];
  for (const double cost : fitted_costs(samples)) EXPECT_GE(cost, 0);
}

TEST(LiveCosts, WithoutSamplesAreZero) {
  EXPECT_EQ(fitted_costs({}), LiveCosts{});
  EXPECT_EQ(level_of({}, kTrue), 1);
}

TEST(LiveCosts, LevelIsTheLoadOfTheMachine) {
  std::vector<CostSample> samples = samples_of(kTrue, 5);
  for (CostSample& sample : samples) sample.cpu *= 1.5;
  EXPECT_NEAR(level_of(samples, kTrue), 1.5, 1e-9);
}

WholeRun run_of(std::uint64_t passes) {
  WholeRun run;
  run.setting.peers = 2;
  run.setting.rate = 20;
  run.counts.seconds = 10;
  run.counts.passes = passes;
  return run;
}

// Two peers for 10 s, one wake each kTogether.
TEST(LiveCosts, ALoopWakesOnceEachTogether) {
  const double most = 2 * 10 / std::chrono::duration<double>(peer::kTogether).count();
  EXPECT_EQ(cost_counts(run_of(300))[0], 300);
  EXPECT_EQ(cost_counts(run_of(300))[1], 0);
  EXPECT_DOUBLE_EQ(cost_counts(run_of(10'000))[0], most);
  EXPECT_DOUBLE_EQ(cost_counts(run_of(10'000))[1], 10'000 - most);
  EXPECT_EQ(cost_counts(run_of(300))[4], 2 * 10 * 20);
}

// The law of arrivals: a loop that takes all within T after a pass wakes at most 1/T a second,
// and for each datagram if these are rare. The simulated peers' own deadlines are in `idle`.
TEST(LiveCosts, SimulatedPeersCollectArrivals) {
  ScaleSetting setting;
  setting.peers = 2;
  setting.crowd = {"rest", 2};
  setting.rate = 4;
  setting.seconds = 5;
  setting.design = design_of(0);
  const auto wakes = [&](double rate, const char* movement) {
    setting.rate = rate;
    setting.crowd.movement = movement;
    const WholeRun run = run_whole_peers(setting, Meeting::simulated);
    return static_cast<double>(run.counts.passes) / (2 * setting.seconds);
  };
  const double few = wakes(10, "vehicles"), many = wakes(1000, "vehicles");
  EXPECT_GT(few, 2 * 10) << "a tick, and a datagram of the other peer";
  EXPECT_LT(few, 100);
  EXPECT_GE(many, 1000) << "each tick is a pass";
  EXPECT_LT(many, 1000 + 300) << "but arrivals make no more";
}

TEST(DrawnSettings, SeedDecidesAlone) {
  const auto once = drawn_settings({}, 20, 5), again = drawn_settings({}, 20, 5);
  const auto other = drawn_settings({}, 20, 6);
  std::size_t equal = 0;
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_EQ(once[i].peers, again[i].peers);
    EXPECT_EQ(once[i].radius, again[i].radius);
    EXPECT_NO_THROW(check_scale_setting(once[i]));
    equal += once[i].radius == other[i].radius;
  }
  EXPECT_EQ(equal, 0U);
  const auto peers = std::ranges::minmax(once, {}, &ScaleSetting::peers);
  EXPECT_GE(peers.min.peers, 2U);
  EXPECT_LE(peers.max.peers, 16U);
}

WholeRow row_of(double predicted, double measured) {
  WholeRow row{run_of(2000), run_of(2000)};
  for (WholeCounts* counts : {&row.run.counts, &row.simulated.counts})
    counts->datagrams = counts->heard_datagrams = counts->heard_octets = 1000;
  row.run.pose.p99 = row.simulated.pose.p99 = 1;
  row.run.counts.cpu = measured;
  row.simulated.live_cpu = predicted;
  return row;
}

TEST(Prediction, CountsWhatIsWithinItsBar) {
  const std::vector<WholeRow> rows{row_of(1.19, 1), row_of(1.3, 1), row_of(0.7, 1)};
  EXPECT_THAT(prediction_text(rows), HasSubstr("1 of 3 rows are within 20 %"));
  EXPECT_THAT(prediction_text(rows), HasSubstr("1.30"));
  const json object = json::parse(prediction_json(std::span(rows).first(1)));
  EXPECT_DOUBLE_EQ(object["cpu_share"], 0.05);
  EXPECT_NEAR(object["predicted_cpu_share"], 0.0595, 1e-9);
}

// The row with samples of a busier time gets higher costs.
TEST(Prediction, FollowsTheLoadOfItsTurn) {
  std::vector<WholeRow> rows{row_of(0, 1), row_of(0, 1)};
  rows[0].samples = rows[1].samples = samples_of(kTrue, 10);
  for (CostSample& sample : rows[1].samples) sample.cpu *= 2;
  predict(rows);
  EXPECT_NEAR(rows[1].simulated.live_cpu / rows[0].simulated.live_cpu, 2, 0.01);
}

Policy policy_of(double error, double cpu) {
  Policy policy{{}, run_of(10)};
  policy.predicted.pose.p99 = error;
  policy.predicted.counts.cpu = cpu;
  return policy;
}

TEST(PolicyPick, IsTheCheapestWithinTheError) {
  const std::vector<Policy> policies{policy_of(0.5, 3), policy_of(1, 2), policy_of(2, 1)};
  EXPECT_EQ(cheapest_policy(policies, 1), &policies[1]);
  EXPECT_EQ(cheapest_policy(policies, 5), &policies[2]);
  EXPECT_EQ(cheapest_policy(policies, 0.1), nullptr);
}

TEST(PolicyPick, NeighboursDifferInOneListEach) {
  EXPECT_EQ(neighbours_of({0, 0, 0}).size(), 3U);
  const PolicyPlace middle{2, 1, 1};
  EXPECT_EQ(neighbours_of(middle).size(), 6U);
  for (const PolicyPlace& place : neighbours_of(middle)) {
    std::size_t steps = 0;
    for (std::size_t i = 0; i < place.size(); ++i)
      steps += std::max(place[i], middle[i]) - std::min(place[i], middle[i]);
    EXPECT_EQ(steps, 1U);
  }
}

TEST(PolicyPick, IsConfirmedUnlessANeighbourIsCheaper) {
  PolicyPick pick{2, 30, {row_of(1, 1), row_of(1, 0.95)}};
  EXPECT_THAT(pick_text(pick), HasSubstr("confirmed."));
  pick.rows[1].run.counts.cpu = 0.5;
  EXPECT_THAT(pick_text(pick), HasSubstr("cheaper than the pick"));
  EXPECT_THAT(pick_text(pick), HasSubstr("not confirmed"));
  pick.rows[1].run.pose.p99 = 3;
  EXPECT_THAT(pick_text(pick), HasSubstr("the pick is confirmed"));
  EXPECT_THAT(pick_text({2, 30, {}}), HasSubstr("None of 30 policies"));
}

}  // namespace
}  // namespace reckon::bench::prediction_test
