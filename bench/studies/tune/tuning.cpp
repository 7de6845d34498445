// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/tune/tuning.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "reckon/bench/statistics/quantile.hpp"
#include "reckon/bench/studies/frame/pareto.hpp"
#include "reckon/bench/studies/sweep/all_cores.hpp"

namespace reckon::bench {
namespace {

using Algorithm = pdu::DeadReckoningAlgorithm;

// FPB and FVB show the same as FPW and FVW, and static is no dead reckoning.
constexpr std::array<std::string_view, 3> kOnlyAsked{"static", "fpb", "fvb"};

/// Distances above zero, from each sample to the first one at least kLeastStepTime later.
void append_steps(const Track& track, std::vector<double>& steps) {
  const auto& samples = track.samples;
  std::size_t to = 1;
  for (std::size_t from = 0; from < samples.size(); ++from) {
    to = std::max(to, from + 1);
    while (to < samples.size() && samples[to].time - samples[from].time < kLeastStepTime - 1e-9)
      ++to;
    if (to >= samples.size()) return;
    const double step = (samples[to].position - samples[from].position).norm();
    if (step > 0) steps.push_back(step);
  }
}

/// 1, 2, 5, 10, 20 ... : number 0 is 1.
double round_value(int number) {
  constexpr std::array<double, 3> kSteps{1, 2, 5};
  const int decade = number >= 0 ? number / 3 : -((2 - number) / 3);
  const double step = kSteps[static_cast<std::size_t>(number - 3 * decade)];
  // Divided by a whole number, 0.005 is the double nearest to it.
  return decade >= 0 ? step * std::pow(10.0, decade) : step / std::pow(10.0, -decade);
}

PoseSetting setting_of(const TuneOptions& options, const TuneRow& row,
                       const std::optional<Algorithm>& algorithm) {
  PoseSetting setting;
  setting.model = algorithm;
  setting.heartbeat = options.heartbeat;
  setting.thresholds.position = row.threshold;
  setting.thresholds.angle = options.angle;
  // If orientations do not count, they must not slow the convergence of the position either.
  if (options.angle >= std::numbers::pi) setting.convergence.gentle_turn = 1e9;
  if (row.threshold == 0) {
    // Shorter than the time between any two samples.
    setting.period = 1e-12;
    setting.thresholds = {};
    setting.convergence.curve = deadreckon::ConvergenceCurve::snap;
  }
  return setting;
}

/// A run to be done on any core.
struct Job {
  TuneRow* row;
  std::optional<Algorithm> algorithm;
};

void run_row(std::span<const Track> tracks, const TuneOptions& options, double span,
             const Job& job) {
  TuneRow& row = *job.row;
  row.result = run_pose_study(tracks, setting_of(options, row, job.algorithm), options.network);
  row.packets_per_s = span > 0 ? static_cast<double>(row.result.updates) / span : 0;
  row.octets_per_s = kUpdateOctets * row.packets_per_s;
}

/// Bisects the ratio of two thresholds: one has a small enough error, the other does not.
std::optional<TuneRow> match(std::span<const Track> tracks, const TuneOptions& options,
                             const TuneRow& common, double span) {
  const PoseModel& model = options.models.front();
  std::optional<TuneRow> good;
  const auto try_threshold = [&](double threshold) {
    TuneRow row;
    row.model = model.name;
    row.threshold = threshold;
    run_row(tracks, options, span, {&row, model.sent});
    const bool is_good = row.error() <= common.error();
    if (is_good) good = row;
    return is_good;
  };
  double low = common.threshold / 4, high = common.threshold * 100;
  if (!try_threshold(low)) return std::nullopt;
  if (try_threshold(high)) return good;
  while (high > 1.01 * low) {
    const double middle = std::sqrt(low * high);
    (try_threshold(middle) ? low : high) = middle;
  }
  return good;
}

/// Convergence may differ slightly for the same updates.
bool same_result(const PoseResult& a, const PoseResult& b) {
  constexpr double kAlike = 0.05;
  return a.updates == b.updates &&
         std::abs(a.position.p99 - b.position.p99) <= kAlike * b.position.p99;
}

/// Removes each model that sends the same updates as an earlier one at each threshold.
void drop_twins(TuneTable& table, std::size_t thresholds) {
  std::vector<TuneRow> kept;
  const auto find_twin = [&](std::size_t begin) -> const TuneRow* {
    for (std::size_t other = 0; other < kept.size(); other += thresholds) {
      bool same = true;
      for (std::size_t i = 0; i < thresholds && same; ++i)
        same = same_result(kept[other + i].result, table.rows[begin + i].result);
      if (same) return &kept[other];
    }
    return nullptr;
  };
  for (std::size_t begin = 0; begin < table.rows.size(); begin += thresholds) {
    const TuneRow* twin = find_twin(begin);
    const auto first = table.rows.begin() + static_cast<std::ptrdiff_t>(begin);
    if (twin == nullptr)
      kept.insert(kept.end(), first, first + static_cast<std::ptrdiff_t>(thresholds));
    else
      table.twins.push_back({table.rows[begin].model, twin->model});
  }
  table.rows = std::move(kept);
}

std::vector<std::size_t> front_of(std::span<const TuneRow> rows) {
  std::vector<std::size_t> front;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i].on_front && rows[i].packets_per_s > 0 && rows[i].error() > 0) front.push_back(i);
  std::sort(front.begin(), front.end(), [&](std::size_t a, std::size_t b) {
    return rows[a].packets_per_s < rows[b].packets_per_s;
  });
  return front;
}

}  // namespace

std::span<const PoseModel> tune_models() {
  const auto as_sent = [](const PoseModel& model) {
    return model.prediction == Prediction::as_sent;
  };
  return {kPoseModels.begin(), std::ranges::find_if_not(kPoseModels, as_sent)};
}

std::vector<PoseModel> default_tune_models() {
  std::vector<PoseModel> models;
  for (const PoseModel& model : tune_models())
    if (std::ranges::find(kOnlyAsked, model.name) == kOnlyAsked.end()) models.push_back(model);
  return models;
}

TrackSummary summary_of(std::span<const Track> tracks) {
  TrackSummary summary;
  summary.entities = tracks.size();
  std::vector<double> intervals, steps;
  double first = 0, last = 0;
  for (const Track& track : tracks) {
    const auto& samples = track.samples;
    if (samples.empty()) continue;
    if (summary.samples == 0) first = last = samples.front().time;
    first = std::min(first, samples.front().time);
    last = std::max(last, samples.back().time);
    summary.samples += samples.size();
    for (std::size_t i = 1; i < samples.size(); ++i)
      intervals.push_back(samples[i].time - samples[i - 1].time);
    append_steps(track, steps);
  }
  summary.span = last - first;
  summary.interval = median(intervals);
  summary.step = median(steps);
  return summary;
}

std::vector<double> threshold_ladder(double step) {
  if (!std::isfinite(step) || !(step > 0)) step = 0.1;
  // Within the range of thresholds in a scene file.
  const double least = std::clamp(step / 100, 1e-6, 1e3);
  const double most = std::clamp(step * 10, 1e-5, 1e4);
  std::vector<double> ladder;
  int number = 3 * static_cast<int>(std::floor(std::log10(least)));
  for (; round_value(number) <= most * (1 + 1e-9); ++number)
    if (round_value(number) >= least * (1 - 1e-9)) ladder.push_back(round_value(number));
  return ladder;
}

TuneTable tune(std::span<const Track> tracks, const TuneOptions& options,
               const std::function<bool(std::size_t, std::size_t)>& progress) {
  const double span = summary_of(tracks).span;
  TuneTable table;
  table.every_sample.model = "static";
  table.common.model = "rvw";
  table.common.threshold = 1;
  for (const PoseModel& model : options.models)
    for (const double threshold : options.thresholds) {
      TuneRow& row = table.rows.emplace_back();
      row.model = model.name;
      row.threshold = threshold;
    }
  std::vector<Job> jobs{{&table.every_sample, Algorithm::static_}, {&table.common, Algorithm::rvw}};
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    jobs.push_back({&table.rows[i], options.models[i / options.thresholds.size()].sent});

  table.stopped = progress && !progress(0, jobs.size());
  if (table.stopped) return table;
  table.stopped = !run_on_all_cores(
      jobs.size(),
      [&](std::size_t i, const std::atomic<bool>&) { run_row(tracks, options, span, jobs[i]); },
      [&](std::size_t done) { return !progress || progress(done, jobs.size()); });
  if (table.stopped) return table;
  if (!options.models.empty()) table.matched = match(tracks, options, table.common, span);
  if (options.drop_twins) drop_twins(table, options.thresholds.size());
  mark_front(table.rows);
  table.knee = knee_of(table.rows);
  return table;
}

void mark_front(std::span<TuneRow> rows) {
  std::vector<Costs> costs;
  for (const TuneRow& row : rows) costs.push_back({row.packets_per_s, row.error(), 0});
  const auto marks = mark_front(costs);
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].on_front = !marks[i];
}

std::optional<std::size_t> knee_of(std::span<const TuneRow> rows) {
  const std::vector<std::size_t> front = front_of(rows);
  if (front.size() < 3) return std::nullopt;
  const TuneRow& cheap = rows[front.front()];
  const TuneRow& dear = rows[front.back()];
  const double width = std::log(dear.packets_per_s / cheap.packets_per_s);
  const double height = std::log(cheap.error() / dear.error());
  double deepest = kLeastBend;
  std::optional<std::size_t> knee;
  for (const std::size_t i : front) {
    const double x = std::log(rows[i].packets_per_s / cheap.packets_per_s) / width;
    const double y = std::log(rows[i].error() / dear.error()) / height;
    const double below = (1 - x - y) / std::sqrt(2.0);
    if (below > deepest) {
      deepest = below;
      knee = i;
    }
  }
  return knee;
}

std::optional<double> price_of_half(std::span<const TuneRow> rows) {
  const std::vector<std::size_t> front = front_of(rows);
  if (front.size() < 2) return std::nullopt;
  const TuneRow& cheap = rows[front.front()];
  const TuneRow& dear = rows[front.back()];
  return std::exp(std::log(dear.packets_per_s / cheap.packets_per_s) * std::log(2.0) /
                  std::log(cheap.error() / dear.error()));
}

std::optional<std::size_t> cheapest_within(std::span<const TuneRow> rows, double error) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i].error() <= error && (!best || rows[i].packets_per_s < rows[*best].packets_per_s))
      best = i;
  return best;
}

std::optional<std::size_t> best_within(std::span<const TuneRow> rows, double packets_per_s) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i].packets_per_s <= packets_per_s && (!best || rows[i].error() < rows[*best].error()))
      best = i;
  return best;
}

}  // namespace reckon::bench
