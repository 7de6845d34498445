// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Time of a viewer's query for the current pose, for each model and convergence curve.
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

  std::array<ByCurve, kModelCount> as_sent{};  ///< by the model of the update
  ByCurve adaptive{};

  /// Cost for a run: its models weighted by the number of updates sent with each.
  [[nodiscard]] double of(const PoseResult& result, Prediction prediction,
                          deadreckon::ConvergenceCurve curve) const;
};

/// Measures all of them in blocks that alternate, with the steady clock, and returns the median
/// block of each. Takes about 0.1 s. The only part of the pose studies that is not deterministic.
[[nodiscard]] QueryCosts measure_query_costs();

}  // namespace reckon::bench
