// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Model x threshold x convergence curve for one subject: the cost and the error of each setting,
// and the settings that no other dominates.
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

/// A heartbeat that never occurs within a study [s].
inline constexpr double kNoHeartbeat = 1e9;

/// A threshold that no angle exceeds [rad].
inline constexpr double kAnyAngle = 4;

/// The moving entities: a motion of the list, or a file.
struct StudySubject {
  std::string name;
  std::string meaning;
  std::vector<Track> tracks;
};

/// The settings that are tried, and their common parameters.
struct AccuracyGrid {
  std::vector<PoseModel> models{kPoseModels.begin(), kPoseModels.end()};
  std::vector<double> thresholds{1.0};  ///< [m] > 0
  std::vector<deadreckon::ConvergenceCurve> curves{deadreckon::ConvergenceCurve::cubic};
  double angle = deadreckon::Thresholds{}.angle;  ///< threshold of orientation [rad] > 0
  double heartbeat = 5.0;                         ///< [s] > 0
  double first_heartbeat = 0;                     ///< [s], as in PoseSetting
  deadreckon::ConvergenceSettings convergence;    ///< without its curve
  peer::ImpairmentConfig network;                 ///< its seed is the first
  std::uint64_t seeds = 1;                        ///< runs from that seed, > 0; results: medians
};

struct AccuracyRow {
  PoseModel model;
  double threshold = 0;  ///< [m]
  deadreckon::ConvergenceCurve curve = deadreckon::ConvergenceCurve::cubic;
  PoseResult result;
  double query_ns = 0;           ///< 0: not measured
  std::optional<Beaten> beaten;  ///< by another row; empty: on the front

  /// For one entity, on average.
  [[nodiscard]] double octets_per_second() const noexcept {
    return kUpdateOctets * result.updates_per_second();
  }
};

/// For example "rvw+adaptive, cubic, 50 mm".
[[nodiscard]] std::string setting_text(const AccuracyRow& row);

struct AccuracyResult {
  std::string subject, meaning;
  std::size_t entities = 0, samples = 0;
  double seconds = 0;            ///< sum over all entities
  double angle = 0;              ///< threshold that was used [rad]
  double own_velocity_step = 0;  ///< greatest step of the true velocity, by sample [m/s]
  std::vector<AccuracyRow> rows;

  [[nodiscard]] std::size_t on_front() const noexcept;
};

/// The setting to run for a row's model, threshold and curve.
[[nodiscard]] PoseSetting setting_of(const AccuracyGrid& grid, const AccuracyRow& row);

/// Called with the settings done and the total; false ends the study.
using StudyProgress = std::function<bool(std::size_t done, std::size_t all)>;

/// One run for each seed. Every number of the result is the median, except by_model, which is the
/// sum.
[[nodiscard]] PoseResult run_seeds(std::span<const Track> tracks, const PoseSetting& setting,
                                   peer::ImpairmentConfig network, std::uint64_t seeds);

/// Differences of errors [m] and velocity steps [m/s] below this are ignored when settings are
/// compared: the rounding of floats on the wire is as large.
inline constexpr double kNoDifference = 1e-5;

/// Runs every setting of the grid and marks the front of octets/s, p99 of the position error and
/// greatest velocity step, each to three digits. Deterministic. Rows without query times; fewer
/// rows if `go_on` ended it.
[[nodiscard]] AccuracyResult run_accuracy_study(const StudySubject& subject,
                                                const AccuracyGrid& grid,
                                                const StudyProgress& go_on = {});

/// Fills in the query cost of each row.
void note_query_costs(AccuracyResult& result, const QueryCosts& costs);

}  // namespace reckon::bench
