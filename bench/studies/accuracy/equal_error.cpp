// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/accuracy/equal_error.hpp"

#include <cmath>

namespace reckon::bench {
namespace {

constexpr int kPerDecade = 12;
constexpr int kDecades = 3;  // above the baseline; one below
constexpr int kFiner = 10;   // thresholds on each side of the best, between its neighbours

/// Runs a rival at one threshold after another and keeps the best.
class Search {
 public:
  Search(std::span<const Track> tracks, const AccuracyGrid& grid, const StudyProgress& go_on)
      : tracks_(tracks), grid_(grid), go_on_(go_on) {}

  [[nodiscard]] PoseResult run(const PoseModel& model, double threshold) const {
    PoseSetting setting;
    setting.model = model.sent;
    setting.prediction = model.prediction;
    setting.thresholds.position = threshold;
    setting.thresholds.angle = grid_.angle;
    setting.heartbeat = grid_.heartbeat;
    setting.first_heartbeat = grid_.first_heartbeat;
    setting.convergence = grid_.convergence;
    setting.convergence.curve = grid_.curves.front();
    return run_seeds(tracks_, setting, grid_.network, grid_.seeds);
  }

  /// False if the study is to end.
  bool attempt(EqualError& found, double threshold) {
    if (go_on_ && !go_on_(done_++, (kDecades + 1) * kPerDecade + 2 * kFiner)) return false;
    const PoseResult result = run(found.rival, threshold);
    const bool good = result.position.p99 <= found.baseline_result.position.p99;
    if (good && (found.threshold == 0 || result.updates < found.result.updates)) {
      found.threshold = threshold;
      found.result = result;
    }
    return true;
  }

 private:
  std::span<const Track> tracks_;
  const AccuracyGrid& grid_;
  const StudyProgress& go_on_;
  std::size_t done_ = 0;
};

}  // namespace

EqualError find_equal_error(std::span<const Track> tracks, const AccuracyGrid& grid,
                            const PoseModel& baseline, double threshold, const PoseModel& rival,
                            const StudyProgress& go_on) {
  EqualError found;
  found.baseline = baseline;
  found.rival = rival;
  found.baseline_threshold = threshold;
  Search search(tracks, grid, go_on);
  found.baseline_result = search.run(baseline, threshold);
  for (int step = -kPerDecade; step <= kDecades * kPerDecade; ++step) {
    if (!search.attempt(found, threshold * std::pow(10, static_cast<double>(step) / kPerDecade)))
      return found;
  }
  const double best = found.threshold;
  for (int step = -kFiner + 1; best > 0 && step < kFiner; ++step) {
    const double exponent = static_cast<double>(step) / (kPerDecade * kFiner);
    if (step != 0 && !search.attempt(found, best * std::pow(10, exponent))) return found;
  }
  return found;
}

}  // namespace reckon::bench
