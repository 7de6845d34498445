// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/scale/live_costs.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <vector>

#include "reckon/bench/studies/scale/peer_processes.hpp"

namespace reckon::bench {
namespace {

using std::chrono::nanoseconds;

constexpr double kSettling = 1, kMeasured = 2;  // [s]

/// Exercises that differ in what they do most.
struct CostExercise {
  std::size_t peers;
  double rate;           // ticks a second
  std::size_t entities;  // a peer
  std::string_view movement;
  bool every_tick;  // else dead reckoning
};
// THE list.
constexpr std::array kCostExercises{
    CostExercise{2, 2, 1, "rest", false},       // the loop's own deadlines
    CostExercise{2, 60, 1, "rest", false},      // ticks
    CostExercise{4, 25, 1, "vehicles", true},   // a wake for few datagrams
    CostExercise{4, 10, 12, "vehicles", true},  // many datagrams a wake
};

ScaleSetting setting_of(const CostExercise& exercise, std::uint16_t port) {
  ScaleSetting setting;
  setting.peers = exercise.peers;
  setting.crowd = {exercise.movement, exercise.peers * exercise.entities};
  setting.rate = exercise.rate;
  setting.seconds = kMeasured;
  setting.design = {.dead_reckoning = !exercise.every_tick};
  setting.port = port;
  return setting;
}

}  // namespace

CostSample cost_sample(const WholeRun& run, double loops) {
  const WholeCounts& counts = run.counts;
  return {static_cast<double>(counts.passes), static_cast<double>(counts.heard_datagrams),
          run.setting.rate * counts.seconds * static_cast<double>(run.setting.peers),
          counts.cpu - loops};
}

LiveCosts fitted_costs(std::span<const CostSample> samples) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d target = Eigen::Vector3d::Zero(), best = target;
  for (const CostSample& sample : samples) {
    if (!(sample.cpu > 0)) continue;
    const Eigen::Vector3d row =
        Eigen::Vector3d(sample.wakes, sample.datagrams, sample.ticks) / sample.cpu;
    normal += row * row.transpose();
    target += row;
  }
  // Of all choices of costs that are not 0, the best whose costs are positive.
  double least = 0;
  for (unsigned chosen = 1; chosen < 8; ++chosen) {
    Eigen::Matrix3d part = Eigen::Matrix3d::Identity();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    const auto is_chosen = [&](int i) { return (chosen >> i & 1U) != 0; };
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        if (is_chosen(i) && is_chosen(j)) part(i, j) = normal(i, j);
    for (int i = 0; i < 3; ++i)
      if (is_chosen(i)) right(i) = target(i);
    const Eigen::Vector3d costs = part.colPivHouseholderQr().solve(right);
    const double error = costs.dot(normal * costs) - 2 * costs.dot(target);
    if (costs.minCoeff() < 0 || !(error < least)) continue;
    least = error;
    best = costs;
  }
  return {best(0), best(1), best(2)};
}

std::string costs_text(const LiveCosts& costs) {
  return fmt::format("{:.0f} us a wake, {:.1f} us a datagram, {:.0f} us a tick", 1e6 * costs.wake,
                     1e6 * costs.datagram, 1e6 * costs.tick);
}

std::optional<LiveCosts> measure_live_costs(Meeting meeting, const ScaleProgress& progress) {
  const auto first = static_cast<std::uint16_t>(40'000 + getpid() % 20'000);
  std::vector<ScaleSetting> settings;
  std::vector<double> loops;
  std::vector<std::size_t> exercise_of;  // by process
  for (const CostExercise& exercise : kCostExercises) {
    const auto number = static_cast<std::uint16_t>(settings.size());
    exercise_of.insert(exercise_of.end(), exercise.peers, settings.size());
    settings.push_back(setting_of(exercise, static_cast<std::uint16_t>(first + number)));
    loops.push_back(run_whole_peers(settings.back(), Meeting::simulated).counts.cpu);
  }
  ProcessPlan plan;
  plan.count = exercise_of.size();
  plan.lan = meeting == Meeting::lan;
  plan.seconds = kSettling + kMeasured;
  const auto is_first = [&](std::size_t process) {
    return process == 0 || exercise_of[process] != exercise_of[process - 1];
  };
  const auto task = [&](std::size_t process, peer::Link& link, nanoseconds begin) {
    std::size_t peer = 0;
    for (std::size_t p = process; !is_first(p); --p) ++peer;
    return live_for(settings[exercise_of[process]], peer, link, begin,
                    {0, plan.seconds, kSettling});
  };
  const std::vector<PeerProcess> processes = run_peer_processes(plan, task, progress);
  if (processes.empty()) return std::nullopt;
  std::vector<CostSample> samples;
  for (std::size_t e = 0, p = 0; e < settings.size(); p += settings[e++].peers)
    samples.push_back(cost_sample(
        sum_of(settings[e], meeting, std::span(processes).subspan(p, settings[e].peers)),
        loops[e]));
  return fitted_costs(samples);
}

}  // namespace reckon::bench
