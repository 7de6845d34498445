// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What each model and threshold would have cost for recorded motion, and how far off it would have
// shown it: the curve of bandwidth against error, its knee, and the setting to take.
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

/// Those of kPoseModels that viewers predict as sent: all that a scene file takes as `algorithm`.
[[nodiscard]] std::span<const PoseModel> tune_models();
/// Those that are tried unasked: FPB and FVB show what FPW and FVW show, and static is no dead
/// reckoning.
[[nodiscard]] std::vector<PoseModel> default_tune_models();

/// What motion a file holds.
struct TrackSummary {
  std::size_t entities = 0, samples = 0;
  double span = 0;      ///< from the first sample to the last of all [s]
  double interval = 0;  ///< median time from a sample to the next of the entity [s]
  /// Median way from a sample to the next one that is kLeastStepTime later, of what moves [m].
  double step = 0;
};
/// A file of more samples a second is looked at in steps of this [s].
inline constexpr double kLeastStepTime = 0.1;
[[nodiscard]] TrackSummary summary_of(std::span<const Track> tracks);

/// What to try.
struct TuneOptions {
  std::vector<PoseModel> models;
  std::vector<double> thresholds;  ///< of position [m], growing
  double angle = 0;                ///< threshold of orientation [rad] > 0; pi: it does not count
  double heartbeat = 5;            ///< [s]
  bool drop_twins = false;         ///< leave models out that send what another sends
  peer::ImpairmentConfig network;
};

/// One setting and what it gave.
struct TuneRow {
  std::string_view model;
  double threshold = 0;  ///< [m]; 0: every sample is sent
  PoseResult result;
  double packets_per_s = 0;  ///< of all entities, over the file's span
  double octets_per_s = 0;
  bool on_front = false;  ///< no other is both cheaper and better

  [[nodiscard]] double error() const noexcept { return result.position.p99; }  ///< [m]
};

/// Models and thresholds, model by model, and what they are held against.
struct TuneTable {
  std::vector<TuneRow> rows;
  TuneRow every_sample;  ///< each sample sent and held, no dead reckoning
  TuneRow common;        ///< DRM 4 and 1 m, the standard's default threshold
  /// The first model at the widest threshold whose p99 error is not above that of `common`, to 1 %
  /// of the threshold, and 100 m at most; none where 0.25 m is too wide.
  std::optional<TuneRow> matched;
  std::optional<std::size_t> knee;
  /// Models that were left out, and those that sent as many at each threshold with a p99 error
  /// alike within 5 %.
  std::vector<std::array<std::string_view, 2>> twins;
  bool stopped = false;  ///< by `progress`: only some rows were run
};

/// Rounded to 1, 2, 5 times powers of ten, from a hundredth of `step` to ten times; 1 mm to 1 m
/// where nothing moves.
[[nodiscard]] std::vector<double> threshold_ladder(double step);

/// Runs all settings, on all cores; the same result on any number of them. `progress`, where there
/// is one, hears from the calling thread how many of how many are done, and may stop by false.
[[nodiscard]] TuneTable tune(std::span<const Track> tracks, const TuneOptions& options,
                             const std::function<bool(std::size_t, std::size_t)>& progress = {});

/// Marks the rows that no other undercuts in both packets and p99 error; of equal ones the first.
void mark_front(std::span<TuneRow> rows);

/// The row of the front that is farthest below the straight line between the front's ends, both
/// axes logarithmic and scaled to the front's extent: from there on, more packets buy less and
/// fewer packets cost more. None where it lies less than kLeastBend of the extent below.
inline constexpr double kLeastBend = 0.05;
[[nodiscard]] std::optional<std::size_t> knee_of(std::span<const TuneRow> rows);

/// Times the packets that half the error costs, on average from end to end of the front.
[[nodiscard]] std::optional<double> price_of_half(std::span<const TuneRow> rows);

/// The row of the fewest packets with a p99 error of at most `error` [m].
[[nodiscard]] std::optional<std::size_t> cheapest_within(std::span<const TuneRow> rows,
                                                         double error);
/// The row of the least p99 error with at most `packets_per_s`.
[[nodiscard]] std::optional<std::size_t> best_within(std::span<const TuneRow> rows,
                                                     double packets_per_s);

}  // namespace reckon::bench
