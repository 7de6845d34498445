// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/touch/touch_study.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <utility>

#include "reckon/bench/statistics/quantile.hpp"
#include "reckon/bench/timing/cpu_ns.hpp"
#include "reckon/pdu/random/split_mix.hpp"

namespace reckon::bench {
namespace {

using Eigen::Vector3d;

constexpr int kRounds = 21;
constexpr double kTouchBlock = 3e5;  // [ns], approximate length of a block
constexpr std::size_t kMostSteps = 4000;
constexpr double kNoError = 1e-6;  // [N], smaller errors count as equal
constexpr double kSameTime = 1.1;  // times within this ratio count as equal

constexpr std::array kAxes{
    TouchAxis{"order", "order of an elastic body's force model", order_case},
    TouchAxis{"precision", "precision of the contact with a curved surface", precision_case},
    TouchAxis{"integrator", "integrator and rate of a simulated tool at a wall", integrator_case},
    TouchAxis{"effects", "effects of the plan, each on and off", effects_case},
    TouchAxis{"cell", "cells and radius of the area of interest", cell_case},
    TouchAxis{"quantisation", "numbers and times as rounded on the wire", quantisation_case},
    TouchAxis{"owner", "owner of a body that two peers touch", owner_case, true},
};

constexpr std::array kLeftOut{
    LeftOutAxis{"graphics rate", "no force is computed from drawn poses"},
    LeftOutAxis{
        "mesh repair",
        "welding and orienting triangles changes the surface itself: there is no truth to compare"},
    LeftOutAxis{
        "energy port",
        "its limit depends on the hand's motion; see --force, and the stiffness limits of devices"},
    LeftOutAxis{"threshold and delay", "newtons against packets, not against time: --force"},
};

/// CPU time [ns] for each step of one block.
double block(const TouchSetting& setting, std::size_t steps, double& sum) {
  return cpu_ns_of([&] { sum += setting.run(steps); }) / static_cast<double>(steps);
}

/// Errors that are too small to matter count as 0.
double shown(double error) { return error < kNoError ? 0 : error; }

/// Times that differ by less than a tenth count as equal.
bool is_faster(const TouchRow& one, const TouchRow& other) {
  return kSameTime * one.cost.median < other.cost.median;
}

bool errs_no_more(const TouchRow& one, const TouchRow& other) {
  return shown(one.error.p99) <= shown(other.error.p99) &&
         shown(one.error.max) <= shown(other.error.max);
}

/// Rows of an axis over a network compare only with the same touch and delay.
bool are_rivals(const TouchRow& one, const TouchRow& other) {
  if (!one.delayed || !other.delayed) return true;
  return one.delayed->touch == other.delayed->touch && one.delayed->delay == other.delayed->delay;
}

/// The row that dominates row `at`: of several the one with the least error, then the fastest.
std::optional<Beaten> beaten(std::span<const TouchRow> rows, std::size_t at) {
  std::optional<Beaten> best;
  const TouchRow& row = rows[at];
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const TouchRow& other = rows[i];
    if (i == at || !are_rivals(row, other)) continue;
    if (is_faster(row, other) || !errs_no_more(other, row)) continue;
    const bool equal = !is_faster(other, row) && errs_no_more(row, other);
    if (equal && i > at) continue;
    const auto key = [](const TouchRow& of) {
      return std::pair(shown(of.error.p99), of.cost.median);
    };
    if (!best || key(other) < key(rows[best->by])) best = Beaten{i, equal};
  }
  return best;
}

ForceError error_of(const TouchCase& made, std::size_t setting) {
  const TouchSetting& of = made.settings[setting];
  return of.error ? *of.error : touch_error(made.force, of.forces);
}

/// Sets the errors of the rows to the medians of all seeds. @param first the case of the first seed
void set_errors(std::vector<TouchRow>& rows, const TouchAxis& axis, const TouchCase& first,
                TouchConditions conditions) {
  std::vector<std::vector<ForceError>> errors(rows.size());
  const auto take = [&](const TouchCase& made) {
    for (std::size_t i = 0; i < rows.size(); ++i) errors[i].push_back(error_of(made, i));
  };
  take(first);
  for (std::uint64_t i = 1; i < conditions.seeds && (!conditions.go_on || conditions.go_on());
       ++i) {
    ++conditions.seed;
    if (const TouchCase next = axis.make(conditions); next.settings.size() == rows.size())
      take(next);
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::ranges::sort(errors[i], {}, &ForceError::share);
    rows[i].error = errors[i][(errors[i].size() - 1) / 2];
    rows[i].worst = errors[i].back().share;
  }
}

void mark_rows(std::vector<TouchRow>& rows) {
  std::vector<std::optional<Beaten>> marks;
  for (std::size_t i = 0; i < rows.size(); ++i) marks.push_back(beaten(rows, i));
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].beaten = marks[i];
}

}  // namespace

std::span<const TouchAxis> touch_axes() { return kAxes; }
std::span<const LeftOutAxis> left_out_axes() { return kLeftOut; }

ForceError touch_error(std::span<const Vector3d> truth, std::span<const Vector3d> felt) {
  std::vector<double> errors, wanted;
  for (std::size_t i = 0; i < std::min(truth.size(), felt.size()); ++i) {
    errors.push_back((felt[i] - truth[i]).norm());
    wanted.push_back(truth[i].norm());
  }
  return error_size(errors, wanted);
}

void measure_costs(std::span<TouchSetting> settings, const std::function<bool()>& go_on) {
  double sum = 0;
  std::vector<std::size_t> steps(settings.size(), 0);
  std::vector<std::vector<double>> blocks(settings.size());
  for (std::size_t i = 0; i < settings.size(); ++i) {
    if (!settings[i].run) continue;
    const double first = block(settings[i], 100, sum);
    steps[i] = static_cast<std::size_t>(
        std::clamp(kTouchBlock / std::max(first, 1.0), 10.0, static_cast<double>(kMostSteps)));
  }
  for (int round = 0; round < kRounds && (!go_on || go_on()); ++round) {
    for (std::size_t i = 0; i < settings.size(); ++i)
      if (steps[i] > 0) blocks[i].push_back(block(settings[i], steps[i], sum));
  }
  // The sum of all results is used, so that the compiler cannot remove any.
  if (!(sum < std::numeric_limits<double>::infinity())) return;
  for (std::size_t i = 0; i < settings.size(); ++i) {
    if (blocks[i].empty()) continue;
    settings[i].cost = {quantile(blocks[i], 0.5), quantile(blocks[i], 0.1),
                        quantile(blocks[i], 0.9)};
  }
}

TouchResult run_touch_axis(const TouchAxis& axis, const TouchConditions& conditions, bool timed) {
  TouchCase made = axis.make(conditions);
  if (timed) measure_costs(made.settings, conditions.go_on);
  TouchResult result{
      std::string(axis.name), std::string(axis.meaning), made.truth, made.remark, 0, {}};
  for (const Vector3d& force : made.force) result.largest = std::max(result.largest, force.norm());
  for (const TouchSetting& setting : made.settings)
    result.rows.push_back(
        {setting.name, {}, 0, timed ? setting.cost : TouchCost{}, {}, setting.delayed});
  set_errors(result.rows, axis, made, conditions);
  mark_rows(result.rows);
  return result;
}

double phase_of(std::uint64_t seed, unsigned number) {
  std::mt19937_64 engine(seed * 1000 + number);
  return 2 * std::numbers::pi * pdu::unit_of(engine());
}

}  // namespace reckon::bench
