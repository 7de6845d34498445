// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/scale/pick.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace reckon::bench {
namespace {

constexpr double kCheaper = 0.1;  // less CPU than this share is noise
constexpr PolicyPlace kPickSizes{kPickThresholds.size(), kPickCells.size(), kPickPools.size()};

std::string policy_text(const ScaleSetting& setting) {
  return fmt::format(
      "threshold {:.3g} m, cells of {:.3g} m, {} of the pool", setting.thresholds.position,
      setting.grid.cell_size,
      setting.grid.pool == 1 ? "1 group" : fmt::format("{} groups", setting.grid.pool));
}

}  // namespace

ScaleSetting with_policy(const ScaleSetting& exercise, double error, const PolicyPlace& place) {
  ScaleSetting setting = exercise;
  setting.thresholds.position = kPickThresholds[place[0]] * error;
  setting.grid.cell_size = kPickCells[place[1]] * exercise.radius;
  setting.grid.pool = kPickPools[place[2]];
  return setting;
}

std::vector<PolicyPlace> neighbours_of(const PolicyPlace& place) {
  std::vector<PolicyPlace> out;
  for (std::size_t axis = 0; axis < place.size(); ++axis)
    for (const bool up : {false, true}) {
      if (up ? place[axis] + 1 == kPickSizes[axis] : place[axis] == 0) continue;
      out.push_back(place);
      out.back()[axis] += up ? 1 : std::size_t(-1);
    }
  return out;
}

const Policy* cheapest_policy(std::span<const Policy> policies, double error) {
  const Policy* best = nullptr;
  for (const Policy& policy : policies)
    if (policy.predicted.pose.p99 <= error &&
        (best == nullptr || policy.predicted.cpu_share() < best->predicted.cpu_share()))
      best = &policy;
  return best;
}

std::optional<PolicyPick> pick_policy(const ScaleSetting& exercise, double error,
                                      const LiveCosts& costs, Meeting meeting,
                                      const ScaleProgress& progress) {
  const auto predicted = [&](const PolicyPlace& place) {
    WholeRun run =
        run_whole_peers(with_policy(exercise, error, place), Meeting::simulated, progress);
    run.live_cpu = live_cpu(cost_counts(run), costs);
    return run;
  };
  std::vector<Policy> policies;
  for (std::size_t t = 0; t < kPickSizes[0]; ++t)
    for (std::size_t c = 0; c < kPickSizes[1]; ++c)
      for (std::size_t p = 0; p < kPickSizes[2]; ++p) {
        // Cells that share one group are alike.
        if (kPickPools[p] == 1 && c > 0) continue;
        policies.push_back({{t, c, p}, predicted({t, c, p})});
        if (progress && !progress(0)) return std::nullopt;
      }
  PolicyPick pick{error, policies.size(), {}};
  const Policy* best = cheapest_policy(policies, error);
  if (best == nullptr) return pick;
  std::vector<PolicyPlace> places = neighbours_of(best->place);
  places.insert(places.begin(), best->place);
  for (const PolicyPlace& place : places) {
    auto row = predicted_and_measured(predicted(place), meeting, {}, progress);
    if (!row) return std::nullopt;
    pick.rows.push_back(std::move(*row));
  }
  predict(pick.rows);
  return pick;
}

std::string pick_text(const PolicyPick& pick) {
  if (pick.rows.empty())
    return fmt::format("None of {} policies is predicted to reach a p99 error of {:g} m.\n",
                       pick.tried, pick.error);
  const WholeRun& best = pick.rows.front().run;
  std::string out =
      fmt::format("Cheapest of {} policies by prediction, within a p99 error of {:g} m: {}\n",
                  pick.tried, pick.error, policy_text(best.setting));
  bool stays = true;
  for (const WholeRow& row : pick.rows) {
    const bool within = row.run.pose.p99 <= pick.error;
    const bool cheaper = within && row.run.cpu_share() < (1 - kCheaper) * best.cpu_share();
    stays = stays && !cheaper;
    out += fmt::format("- {}: measured {:.2f} m, {:.2f} % of a core, {:.0f} B/s heard{}{}\n",
                       policy_text(row.run.setting), row.run.pose.p99, 100 * row.run.cpu_share(),
                       static_cast<double>(row.run.counts.heard_octets) / row.run.counts.seconds /
                           static_cast<double>(row.run.setting.peers),
                       within ? "" : ", error too large", cheaper ? ", cheaper than the pick" : "");
  }
  return out + (stays && best.pose.p99 <= pick.error
                    ? "No neighbour within the error is cheaper: the pick is confirmed.\n"
                    : "The pick is not confirmed.\n");
}

}  // namespace reckon::bench
