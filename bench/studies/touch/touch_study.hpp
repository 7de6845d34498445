// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What accuracy of a force costs in servo time: for each axis of a servo step (order of a model,
// precision of a contact, integrator, effects, cells, numbers on the wire) the ways to compute it,
// how far each is from the truth in newtons, and what it takes in nanoseconds.
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

/// A servo step has this long [ns].
inline constexpr double kServoBudget = 1e6;

/// Nanoseconds for one millisecond of touch, which is one servo step at 1 kHz.
struct TouchCost {
  double median = 0;         ///< of blocks; 0: not measured
  double low = 0, high = 0;  ///< 10 and 90 % of them below; 0: not known
};

/// One way to compute the forces of an axis.
struct TouchSetting {
  std::string name;
  std::vector<Eigen::Vector3d> forces;  ///< [N], each millisecond, beside TouchCase::truth
  /// Computes so many milliseconds more, over and over the same motion; anything made of all the
  /// answers. Empty where `cost` is measured already.
  std::function<double(std::size_t steps)> run;
  std::optional<ForceError> error = {};  ///< in the place of `forces`, where the truth differs
  TouchCost cost = {};
};

/// What an axis compares.
struct TouchCase {
  std::string truth;                   ///< what is taken for true, one sentence
  std::string remark;                  ///< what to know of the rows; may be empty
  std::vector<Eigen::Vector3d> force;  ///< [N], each millisecond: the truth
  std::vector<TouchSetting> settings;
};

/// One axis. The same case for the same seed, but for costs.
struct TouchAxis {
  std::string_view name, meaning;
  TouchCase (*make)(std::uint64_t seed);
};

/// THE list of axes.
[[nodiscard]] std::span<const TouchAxis> touch_axes();

/// Has no honest error in newtons of its own, and why.
struct LeftOutAxis {
  std::string_view name, why;
};
[[nodiscard]] std::span<const LeftOutAxis> left_out_axes();

struct TouchRow {
  std::string setting;
  ForceError error;
  TouchCost cost;
  std::optional<Beaten> beaten;  ///< by another row of the axis, see run_touch_axis()
  /// Whether a person may notice it in more than 1 % of the time.
  [[nodiscard]] bool is_felt() const noexcept { return error.noticed > 0.01; }
};

struct TouchResult {
  std::string axis, meaning, truth, remark;
  double largest = 0;  ///< of the true force [N]; 0 where each row has its own
  std::vector<TouchRow> rows;
};

/// Sizes of |felt - truth|, both of one length.
[[nodiscard]] ForceError touch_error(std::span<const Eigen::Vector3d> truth,
                                     std::span<const Eigen::Vector3d> felt);

/// What each setting takes: blocks that take turns, by the steady clock; some 0.1 s a setting. The
/// only part of the study that two runs disagree on. @param go_on false ends it early.
void measure_costs(std::span<TouchSetting> settings, const std::function<bool()>& go_on = {});

/// Errors, and costs where `timed`; then what is dominated: another row errs no more (p99 and
/// largest, to 1 uN) and takes no more time, and is better in one; times within 10 % are the same.
[[nodiscard]] TouchResult run_touch_axis(const TouchAxis& axis, std::uint64_t seed, bool timed,
                                         const std::function<bool()>& go_on = {});

/// `reckon bench accuracy --touch`. @param axes words with names between commas; none: all
/// @throws UsageError for an axis that is not there
[[nodiscard]] StudyOutput run_touch_study(const std::vector<std::string>& axes, std::uint64_t seed,
                                          bool json, const StudyCall& call);

// The axes, one file each.
[[nodiscard]] TouchCase order_case(std::uint64_t seed);
[[nodiscard]] TouchCase precision_case(std::uint64_t seed);
[[nodiscard]] TouchCase integrator_case(std::uint64_t seed);
[[nodiscard]] TouchCase effects_case(std::uint64_t seed);
[[nodiscard]] TouchCase cell_case(std::uint64_t seed);
[[nodiscard]] TouchCase quantisation_case(std::uint64_t seed);

/// An angle by seed, 0 to 2 pi, the `number`th [rad].
[[nodiscard]] double phase_of(std::uint64_t seed, unsigned number);

}  // namespace reckon::bench
