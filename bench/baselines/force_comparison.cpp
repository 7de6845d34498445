// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/baselines/force_comparison.hpp"

#include <cmath>

#include "reckon/bench/baselines/coupling_simulation.hpp"
#include "reckon/bench/statistics/quantile.hpp"

namespace reckon::bench {
namespace {

double sum_of_squares(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return sum;
}

double rms(const std::vector<double>& values) {
  return values.empty() ? 0.0
                        : std::sqrt(sum_of_squares(values) / static_cast<double>(values.size()));
}

}  // namespace

ForceComparison::ForceComparison(std::size_t samples) {
  errors_.reserve(2 * samples);
  truths_.reserve(2 * samples);
}

void ForceComparison::note(double shown, double truth, double here) {
  in_phase_ += shown * here;
  here_ += here * here;
  if (shown == 0.0 && truth == 0.0) return;
  errors_.push_back(std::abs(shown - truth));
  truths_.push_back(std::abs(truth));
}

void ForceComparison::finish(CouplingOutcome& outcome) {
  outcome.stiffness_kept = here_ > 0 ? in_phase_ / here_ : 0.0;
  outcome.error_rms = rms(errors_);
  outcome.truth_rms = rms(truths_);
  outcome.error_p95 = quantile(errors_, 0.95);
  outcome.truth_p95 = quantile(truths_, 0.95);
}

}  // namespace reckon::bench
