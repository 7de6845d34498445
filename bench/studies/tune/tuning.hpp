// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cost and error that each model and threshold would have had for recorded motion: the curve of
// bandwidth against error, its knee, and the recommended setting.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/bench/studies/pose/pose_models.hpp"
#include "reckon/bench/studies/pose/pose_study.hpp"
#include "reckon/bench/studies/tracks/track.hpp"

namespace reckon::bench {

/// The models of kPoseModels that viewers predict as sent: all values of `algorithm` in a scene
/// file.
[[nodiscard]] std::span<const PoseModel> tune_models();
/// The models that are tried by default: FPB and FVB show the same as FPW and FVW, and static is no
/// dead reckoning.
[[nodiscard]] std::vector<PoseModel> default_tune_models();

/// Summary of the motion in a file.
struct TrackSummary {
  std::size_t entities = 0, samples = 0;
  double span = 0;      ///< from the first sample of all entities to the last [s]
  double interval = 0;  ///< median time from a sample to the next of the same entity [s]
  /// Median distance from a sample to the first one at least kLeastStepTime later, over what moves
  /// [m].
  double step = 0;
};
/// A file with more samples a second is evaluated in steps of this length [s].
inline constexpr double kLeastStepTime = 0.1;
[[nodiscard]] TrackSummary summary_of(std::span<const Track> tracks);

/// The settings to try.
struct TuneOptions {
  std::vector<PoseModel> models;
  std::vector<double> thresholds;  ///< of position [m], ascending
  double angle = 0;                ///< threshold of orientation [rad] > 0; pi: it does not count
  double heartbeat = 5;            ///< [s]
  bool drop_twins = false;         ///< remove models that send the same as another
  peer::ImpairmentConfig network;
};

/// One setting and its result.
struct TuneRow {
  std::string_view model;
  double threshold = 0;  ///< [m]; 0: every sample is sent
  PoseResult result;
  double packets_per_s = 0;  ///< of all entities, over the file's span
  double octets_per_s = 0;
  bool on_front = false;  ///< no other row has both fewer packets and a smaller error

  [[nodiscard]] double error() const noexcept { return result.position.p99; }  ///< [m]
};

/// Models and thresholds, model by model, and the baselines.
struct TuneTable {
  std::vector<TuneRow> rows;
  TuneRow every_sample;  ///< each sample sent and held, no dead reckoning
  TuneRow common;        ///< DRM 4 and 1 m, the standard's default threshold
  /// The first model at the greatest threshold whose p99 error is at most the error of `common`, to
  /// 1 % of the threshold, at most 100 m; none if the error is greater at 0.25 m.
  std::optional<TuneRow> matched;
  std::optional<std::size_t> knee;
  /// Models that were removed, each with the model that sent as many updates at each threshold,
  /// with p99 errors equal within 5 %.
  std::vector<std::array<std::string_view, 2>> twins;
  bool stopped = false;  ///< by `progress`: only some rows were run
};

/// Values of 1, 2, 5 times powers of ten, from a hundredth of `step` to ten times `step`; 1 mm to 1
/// m if nothing moves.
[[nodiscard]] std::vector<double> threshold_ladder(double step);

/// Runs all settings on all cores; the result is the same for any number of cores. `progress`, if
/// given, is called by the calling thread with the number done and the total, and may stop the run
/// by returning false.
[[nodiscard]] TuneTable tune(std::span<const Track> tracks, const TuneOptions& options,
                             const std::function<bool(std::size_t, std::size_t)>& progress = {});

/// Marks the rows for which no other has both fewer packets and a smaller p99 error; of equal rows
/// the first.
void mark_front(std::span<TuneRow> rows);

/// The row of the front that is farthest below the straight line between the ends of the front,
/// both axes logarithmic and scaled to the front's extent: beyond it more packets reduce the error
/// less, and before it fewer packets increase the error more. None if it lies less than kLeastBend
/// of the extent below the line.
inline constexpr double kLeastBend = 0.05;
[[nodiscard]] std::optional<std::size_t> knee_of(std::span<const TuneRow> rows);

/// Factor of packets for half the error, on average from end to end of the front.
[[nodiscard]] std::optional<double> price_of_half(std::span<const TuneRow> rows);

/// The row with the fewest packets and a p99 error of at most `error` [m].
[[nodiscard]] std::optional<std::size_t> cheapest_within(std::span<const TuneRow> rows,
                                                         double error);
/// The row with the least p99 error and at most `packets_per_s`.
[[nodiscard]] std::optional<std::size_t> best_within(std::span<const TuneRow> rows,
                                                     double packets_per_s);

}  // namespace reckon::bench
