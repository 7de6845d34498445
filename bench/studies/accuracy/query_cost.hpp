// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a viewer's question "where is it now?" costs in time, for each model and convergence curve.
#pragma once

#include <array>

#include "reckon/bench/studies/pose/pose_study.hpp"
#include "reckon/deadreckon/motion/convergence.hpp"
#include "reckon/pdu/codec/enumerations.hpp"

namespace reckon::bench {

/// Nanoseconds of one predicted and converged pose.
struct QueryCosts {
  static constexpr std::size_t kCurves = deadreckon::kConvergenceCurves.size();
  using ByCurve = std::array<double, kCurves>;

  std::array<ByCurve, kModelCount> as_sent{};  ///< by model of the update
  ByCurve adaptive{};

  /// Of a run: its models weighted by the updates they were sent with.
  [[nodiscard]] double of(const PoseResult& result, Prediction prediction,
                          deadreckon::ConvergenceCurve curve) const;
};

/// Measures all of them in blocks that take turns, and gives the median block of each, by the
/// steady clock. Takes some 0.1 s. The only part of the pose studies that two runs disagree on.
[[nodiscard]] QueryCosts measure_query_costs();

}  // namespace reckon::bench
