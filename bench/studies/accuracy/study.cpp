// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/accuracy/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reckon/bench/statistics/quantile.hpp"
#include "reckon/bench/studies/pose/study_text.hpp"

namespace reckon::bench {
namespace {

using Eigen::Vector3d;

template <typename Of>
double median_of(const std::vector<PoseResult>& runs, Of&& of) {
  std::vector<double> values;
  for (const PoseResult& run : runs) values.push_back(of(run));
  return median(values);
}

ErrorSize median_size(const std::vector<PoseResult>& runs, ErrorSize PoseResult::*size) {
  return {median_of(runs, [=](const PoseResult& run) { return (run.*size).rms; }),
          median_of(runs, [=](const PoseResult& run) { return (run.*size).p99; }),
          median_of(runs, [=](const PoseResult& run) { return (run.*size).max; })};
}

double own_velocity_step(std::span<const Track> tracks) {
  double greatest = 0;
  for (const Track& track : tracks) {
    for (std::size_t i = 2; i < track.samples.size(); ++i) {
      const auto drawn = [&](std::size_t at) -> Vector3d {
        const auto &now = track.samples[at], &before = track.samples[at - 1];
        return (now.position - before.position) / (now.time - before.time);
      };
      greatest = std::max(greatest, (drawn(i) - drawn(i - 1)).norm());
    }
  }
  return greatest;
}

std::vector<AccuracyRow> rows_of(const AccuracyGrid& grid) {
  std::vector<AccuracyRow> rows;
  for (const PoseModel& model : grid.models) {
    for (const double threshold : grid.thresholds) {
      for (const auto curve : grid.curves) rows.push_back({model, threshold, curve, {}, 0, {}});
    }
  }
  return rows;
}

/// With the digits of the tables: a smaller difference does not justify a row.
double compared(double value) {
  return std::abs(value) >= kNoDifference ? in_three_digits(value) : 0;
}

void mark_rows(std::vector<AccuracyRow>& rows) {
  std::vector<Costs> costs;
  for (const AccuracyRow& row : rows)
    costs.push_back({compared(row.octets_per_second()), compared(row.result.position.p99),
                     compared(row.result.velocity_step.max)});
  const auto marks = mark_front(costs);
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].beaten = marks[i];
}

}  // namespace

PoseSetting setting_of(const AccuracyGrid& grid, const AccuracyRow& row) {
  PoseSetting setting;
  setting.model = row.model.sent;
  setting.prediction = row.model.prediction;
  setting.thresholds.position = row.threshold;
  setting.thresholds.angle = grid.angle;
  setting.heartbeat = grid.heartbeat;
  setting.first_heartbeat = grid.first_heartbeat;
  setting.convergence = grid.convergence;
  setting.convergence.curve = row.curve;
  return setting;
}

std::string setting_text(const AccuracyRow& row) {
  const auto& curve = deadreckon::kConvergenceCurves[static_cast<std::size_t>(row.curve)];
  return fmt::format("{}, {}, {}", row.model.name, curve.name, length_text(row.threshold));
}

std::size_t AccuracyResult::on_front() const noexcept {
  return static_cast<std::size_t>(
      std::count_if(rows.begin(), rows.end(), [](const AccuracyRow& row) { return !row.beaten; }));
}

PoseResult run_seeds(std::span<const Track> tracks, const PoseSetting& setting,
                     peer::ImpairmentConfig network, std::uint64_t seeds) {
  std::vector<PoseResult> runs;
  for (std::uint64_t i = 0; i < seeds; ++i, ++network.seed)
    runs.push_back(run_pose_study(tracks, setting, network));
  if (runs.size() == 1) return runs.front();
  PoseResult middle;
  const auto count = [](double value) { return static_cast<std::uint64_t>(value); };
  middle.updates =
      count(median_of(runs, [](const auto& run) { return static_cast<double>(run.updates); }));
  middle.samples =
      count(median_of(runs, [](const auto& run) { return static_cast<double>(run.samples); }));
  middle.entity_seconds = median_of(runs, [](const auto& run) { return run.entity_seconds; });
  middle.position = median_size(runs, &PoseResult::position);
  middle.angle = median_size(runs, &PoseResult::angle);
  middle.velocity_step = median_size(runs, &PoseResult::velocity_step);
  for (const PoseResult& run : runs) {
    for (std::size_t model = 0; model < kModelCount; ++model)
      middle.by_model[model] += run.by_model[model];
  }
  return middle;
}

AccuracyResult run_accuracy_study(const StudySubject& subject, const AccuracyGrid& grid,
                                  const StudyProgress& go_on) {
  AccuracyResult result;
  result.subject = subject.name;
  result.meaning = subject.meaning;
  result.angle = grid.angle;
  result.entities = subject.tracks.size();
  for (const Track& track : subject.tracks) {
    result.samples += track.samples.size();
    if (!track.samples.empty())
      result.seconds += track.samples.back().time - track.samples.front().time;
  }
  result.own_velocity_step = own_velocity_step(subject.tracks);
  result.rows = rows_of(grid);
  for (std::size_t i = 0; i < result.rows.size(); ++i) {
    if (go_on && !go_on(i, result.rows.size())) {
      result.rows.resize(i);
      break;
    }
    AccuracyRow& row = result.rows[i];
    row.result = run_seeds(subject.tracks, setting_of(grid, row), grid.network, grid.seeds);
  }
  mark_rows(result.rows);
  return result;
}

void note_query_costs(AccuracyResult& result, const QueryCosts& costs) {
  for (AccuracyRow& row : result.rows)
    row.query_ns = costs.of(row.result, row.model.prediction, row.curve);
}

}  // namespace reckon::bench
