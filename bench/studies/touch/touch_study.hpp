// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cost of force accuracy in servo time. For each axis of a servo step (order of a model, precision
// of a contact, integrator, effects, cells, numbers on the wire) it compares the ways to compute
// it: their error in newtons and their time in nanoseconds.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/bench/studies/contact/contact_measures.hpp"
#include "reckon/bench/studies/frame/pareto.hpp"
#include "reckon/bench/studies/frame/study.hpp"

namespace reckon::bench {

/// Length of a servo step [ns].
inline constexpr double kServoBudget = 1e6;

/// Nanoseconds for one millisecond of touch, which is one servo step at 1 kHz.
struct TouchCost {
  double median = 0;         ///< over blocks; 0: not measured
  double low = 0, high = 0;  ///< 10 and 90 % of the blocks are below; 0: not known
};

/// A setting of an axis over a network: the picture has a line for each way of touching and rule.
struct DelayedTouch {
  std::string_view touch, rule;
  double delay = 0;  ///< [s], one way
};

/// One way to compute the forces of an axis.
struct TouchSetting {
  std::string name;
  std::vector<Eigen::Vector3d> forces;  ///< [N], each millisecond; see TouchCase::truth
  /// Computes this many further milliseconds of the same repeated motion. Returns any value that
  /// depends on all results. Empty if `cost` is already measured.
  std::function<double(std::size_t steps)> run;
  std::optional<ForceError> error = {};  ///< instead of `forces`, if the truth differs
  TouchCost cost = {};
  std::optional<DelayedTouch> delayed = {};  ///< compared with settings of its touch and delay only
};

/// The settings that an axis compares.
struct TouchCase {
  std::string truth;                   ///< the reference, in one sentence
  std::string remark;                  ///< a remark about the rows; may be empty
  std::vector<Eigen::Vector3d> force;  ///< [N], each millisecond: the reference
  std::vector<TouchSetting> settings;
};

/// What all cases of a run have in common.
struct TouchConditions {
  std::uint64_t seed = 1;
  std::uint64_t seeds = 1;  ///< number of runs, with seeds from `seed` on
  /// For axes with TouchAxis::has_network. Delay [s], one way; none: each delay of the axis.
  std::optional<double> delay = {};
  double loss = 0;                   ///< share of the datagrams, for the same axes
  std::function<bool()> go_on = {};  ///< false ends a case early, with the settings so far
};

/// One axis. The case is the same for the same seed, except for costs.
struct TouchAxis {
  std::string_view name, meaning;
  TouchCase (*make)(const TouchConditions& conditions);
  bool has_network = false;  ///< uses the delay and the loss of the conditions
};

/// The list of axes.
[[nodiscard]] std::span<const TouchAxis> touch_axes();

/// An axis without a meaningful error in newtons of its own, and the reason.
struct LeftOutAxis {
  std::string_view name, why;
};
[[nodiscard]] std::span<const LeftOutAxis> left_out_axes();

struct TouchRow {
  std::string setting;
  ForceError error;  ///< median of the seeds, by ForceError::share
  double worst = 0;  ///< greatest share of the seeds
  TouchCost cost;
  std::optional<Beaten> beaten;  ///< by another row of the axis, see run_touch_axis()
  std::optional<DelayedTouch> delayed = {};
  /// Whether a person may notice the error in more than 1 % of the time.
  [[nodiscard]] bool is_felt() const noexcept { return error.noticed > 0.01; }
};

struct TouchResult {
  std::string axis, meaning, truth, remark;
  double largest = 0;  ///< greatest true force [N]; 0 if each row has its own
  std::vector<TouchRow> rows;
};

/// Size of |felt - truth|; both have equal length.
[[nodiscard]] ForceError touch_error(std::span<const Eigen::Vector3d> truth,
                                     std::span<const Eigen::Vector3d> felt);

/// Measures the cost of each setting in alternating blocks, with the steady clock; about 0.1 s a
/// setting. The only part of the study that is not deterministic. @param go_on false ends it early.
void measure_costs(std::span<TouchSetting> settings, const std::function<bool()>& go_on = {});

/// Errors of all seeds, and costs of the first one if `timed`; then marks dominated rows: another
/// row has no greater error (p99 and greatest, to 1 uN) and no greater time, and is better in one
/// of them. Times within 10 % count as equal.
[[nodiscard]] TouchResult run_touch_axis(const TouchAxis& axis, const TouchConditions& conditions,
                                         bool timed);

/// `reckon bench accuracy --touch`. @param axes words with names separated by commas; empty: all
/// @throws UsageError for an unknown axis, and for a delay or a loss without an axis that uses it
[[nodiscard]] StudyOutput run_touch_study(const std::vector<std::string>& axes,
                                          TouchConditions conditions, bool json,
                                          const StudyCall& call);

// The axes, one file each.
[[nodiscard]] TouchCase order_case(const TouchConditions& conditions);
[[nodiscard]] TouchCase precision_case(const TouchConditions& conditions);
[[nodiscard]] TouchCase integrator_case(const TouchConditions& conditions);
[[nodiscard]] TouchCase effects_case(const TouchConditions& conditions);
[[nodiscard]] TouchCase cell_case(const TouchConditions& conditions);
[[nodiscard]] TouchCase quantisation_case(const TouchConditions& conditions);
[[nodiscard]] TouchCase owner_case(const TouchConditions& conditions);

/// The `number`th angle for a seed, 0 to 2 pi [rad].
[[nodiscard]] double phase_of(std::uint64_t seed, unsigned number);

}  // namespace reckon::bench
