// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/scale/live_costs.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "reckon/bench/studies/scale/peer_processes.hpp"

namespace reckon::bench {
namespace {

using std::chrono::nanoseconds;

constexpr std::size_t kMostOfCosts = 16;                 // peers
constexpr double kSettling = 0.7;                        // [s]
constexpr double kMeasured = 10, kLeast = 1, kMost = 4;  // [s], of all processes; of one

/// Exercises that differ in what they do most.
struct CostExercise {
  CostHalf half;
  double rate;           // ticks a second
  std::size_t entities;  // a peer
  std::string_view movement;
  bool every_tick;  // else dead reckoning
};
// THE list.
constexpr std::array kCostExercises{
    CostExercise{CostHalf::before, 2, 1, "rest", false},       // the loop's own deadlines
    CostExercise{CostHalf::before, 20, 4, "flyers", false},    // joins
    CostExercise{CostHalf::before, 15, 8, "vehicles", true},   // datagrams
    CostExercise{CostHalf::after, 60, 1, "rest", false},       // ticks
    CostExercise{CostHalf::after, 20, 30, "vehicles", false},  // what to send, what is shown
};

ScaleSetting setting_of(const ScaleSetting& like, const CostExercise& exercise) {
  ScaleSetting setting = like;
  setting.peers = std::min(like.peers, kMostOfCosts);
  setting.crowd.entities = setting.peers * exercise.entities;
  setting.crowd.movement = exercise.movement;
  setting.crowd.tracks = {};
  setting.rate = exercise.rate;
  setting.seconds = std::clamp(kMeasured / static_cast<double>(setting.peers), kLeast, kMost);
  setting.network = {};
  if (exercise.every_tick) setting.design.dead_reckoning = setting.design.bundling = false;
  setting.port = static_cast<std::uint16_t>(40'000 + getpid() % 20'000);
  return setting;
}

constexpr auto kCosts = static_cast<Eigen::Index>(kCostNames.size());
using CostVector = Eigen::Matrix<double, kCosts, 1>;
using CostMatrix = Eigen::Matrix<double, kCosts, kCosts>;

// Usual costs relative to a wake, and their weight relative to the samples.
const CostVector kUsual{{1, 0.25, 0.05, 0.5, 0.2, 1}};
constexpr double kUsualWeight = 0.3;

/// Least squares of the chosen costs; the others are 0. @param chosen a bit each
CostVector solved(const CostMatrix& normal, const CostVector& target, unsigned chosen) {
  CostMatrix part = CostMatrix::Identity();
  CostVector right = CostVector::Zero();
  const auto is_chosen = [&](Eigen::Index i) { return (chosen >> i & 1U) != 0; };
  for (Eigen::Index i = 0; i < kCosts; ++i) {
    if (!is_chosen(i)) continue;
    right(i) = target(i);
    for (Eigen::Index j = 0; j < kCosts; ++j)
      if (is_chosen(j)) part(i, j) = normal(i, j);
  }
  return part.colPivHouseholderQr().solve(right);
}

}  // namespace

LiveCosts fitted_costs(std::span<const CostSample> samples) {
  // In units of a tenth of a millisecond, so that costs are near 1.
  constexpr double kUnit = 1e-4;
  CostMatrix normal = CostMatrix::Zero();
  CostVector target = CostVector::Zero(), best = CostVector::Zero();
  for (const CostSample& sample : samples) {
    const CostVector row = CostVector(sample.counts.data()) * (kUnit / sample.cpu);
    normal += row * row.transpose();
    target += row;
  }
  for (Eigen::Index i = 1; i < kCosts; ++i) {
    // A cost that no sample has is the usual one.
    CostVector row = CostVector::Zero();
    row(i) = kUsualWeight * std::sqrt(std::max(normal(i, i), 1e-6));
    row(0) = -kUsual(i) * row(i);
    normal += row * row.transpose();
  }
  double least = 0;
  for (unsigned chosen = 1; chosen < 1U << kCosts; ++chosen) {
    const CostVector costs = solved(normal, target, chosen);
    const double error = costs.dot(normal * costs) - 2 * costs.dot(target);
    if (costs.minCoeff() < 0 || !(error < least)) continue;
    least = error;
    best = costs;
  }
  LiveCosts costs{};
  for (Eigen::Index i = 0; i < kCosts; ++i) costs[static_cast<std::size_t>(i)] = kUnit * best(i);
  return costs;
}

double level_of(std::span<const CostSample> samples, const LiveCosts& costs) {
  double sum = 0;
  for (const CostSample& sample : samples) sum += sample.cpu / live_cpu(sample.counts, costs);
  return samples.empty() ? 1 : sum / static_cast<double>(samples.size());
}

std::string costs_text(const LiveCosts& costs) {
  std::string out;
  for (std::size_t i = 0; i < costs.size(); ++i)
    out += fmt::format("{}{:.0f} us a {}", i == 0 ? "" : ", ", 1e6 * costs[i], kCostNames[i]);
  return out;
}

std::vector<CostSample> cost_samples(const ScaleSetting& like, Meeting meeting, CostHalf half,
                                     const ScaleProgress& progress) {
  std::vector<CostSample> samples;
  for (const CostExercise& exercise : kCostExercises) {
    if (exercise.half != half) continue;
    const ScaleSetting setting = setting_of(like, exercise);
    const double loops = run_whole_peers(setting, Meeting::simulated).counts.cpu;
    ProcessPlan plan;
    plan.count = setting.peers;
    plan.lan = meeting == Meeting::lan;
    plan.seconds = kSettling + setting.seconds;
    const auto task = [&](std::size_t peer, peer::Link& link, nanoseconds begin) {
      return live_for(setting, peer, link, begin, {0, plan.seconds, kSettling});
    };
    const auto processes = run_peer_processes(plan, task, progress);
    if (processes.empty()) return {};
    const WholeRun run = sum_of(setting, meeting, processes);
    if (run.counts.cpu > loops) samples.push_back({cost_counts(run), run.counts.cpu - loops});
  }
  return samples;
}

}  // namespace reckon::bench
