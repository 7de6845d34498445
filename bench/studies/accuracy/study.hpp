// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Model x threshold x convergence curve over one subject: what each setting costs, how far off it
// is, and which ones nothing beats.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reckon/bench/studies/accuracy/query_cost.hpp"
#include "reckon/bench/studies/frame/pareto.hpp"
#include "reckon/bench/studies/pose/pose_models.hpp"

namespace reckon::bench {

/// A heartbeat that never comes within a study [s].
inline constexpr double kNoHeartbeat = 1e9;

/// A threshold that no angle passes [rad].
inline constexpr double kAnyAngle = 4;

/// What moves: a motion of the list or a file.
struct StudySubject {
  std::string name;
  std::string meaning;
  std::vector<Track> tracks;
};

/// The settings that are tried, and what they have in common.
struct AccuracyGrid {
  std::vector<PoseModel> models{kPoseModels.begin(), kPoseModels.end()};
  std::vector<double> thresholds{1.0};  ///< [m] > 0
  std::vector<deadreckon::ConvergenceCurve> curves{deadreckon::ConvergenceCurve::cubic};
  double angle = deadreckon::Thresholds{}.angle;  ///< threshold of orientation [rad] > 0
  double heartbeat = 5.0;                         ///< [s] > 0
  double first_heartbeat = 0;                     ///< [s], as PoseSetting's
  deadreckon::ConvergenceSettings convergence;    ///< but its curve
  peer::ImpairmentConfig network;                 ///< its seed is the first
  std::uint64_t seeds = 1;                        ///< runs from that seed on, > 0; medians are told
};

struct AccuracyRow {
  PoseModel model;
  double threshold = 0;  ///< [m]
  deadreckon::ConvergenceCurve curve = deadreckon::ConvergenceCurve::cubic;
  PoseResult result;
  double query_ns = 0;           ///< 0: not measured
  std::optional<Beaten> beaten;  ///< by another row; none: on the front

  /// Of one entity, on average.
  [[nodiscard]] double octets_per_second() const noexcept {
    return kUpdateOctets * result.updates_per_second();
  }
};

/// "rvw+adaptive, cubic, 50 mm"
[[nodiscard]] std::string setting_text(const AccuracyRow& row);

struct AccuracyResult {
  std::string subject, meaning;
  std::size_t entities = 0, samples = 0;
  double seconds = 0;            ///< of all entities together
  double angle = 0;              ///< threshold that was used [rad]
  double own_velocity_step = 0;  ///< greatest of the true motion, from sample to sample [m/s]
  std::vector<AccuracyRow> rows;

  [[nodiscard]] std::size_t on_front() const noexcept;
};

/// What is run for a row's model, threshold and curve.
[[nodiscard]] PoseSetting setting_of(const AccuracyGrid& grid, const AccuracyRow& row);

/// Told how many of how many settings are done; false ends the study.
using StudyProgress = std::function<bool(std::size_t done, std::size_t all)>;

/// One run for each seed; of every number of the result the median, but by_model, which is summed.
[[nodiscard]] PoseResult run_seeds(std::span<const Track> tracks, const PoseSetting& setting,
                                   peer::ImpairmentConfig network, std::uint64_t seeds);

/// Errors [m] and velocity steps [m/s] below this are none when settings are compared: the floats
/// on the wire make as much.
inline constexpr double kNoDifference = 1e-5;

/// Runs every setting of the grid and marks the front of octets/s, p99 of the position error and
/// largest velocity step, each to three digits. Deterministic. Rows without query times; fewer
/// where `go_on` ended it.
[[nodiscard]] AccuracyResult run_accuracy_study(const StudySubject& subject,
                                                const AccuracyGrid& grid,
                                                const StudyProgress& go_on = {});

/// Fills in what a query of each row costs.
void note_query_costs(AccuracyResult& result, const QueryCosts& costs);

}  // namespace reckon::bench
