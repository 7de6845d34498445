// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A hand that presses into a wall while the device runs, and holds the handle still otherwise.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <chrono>
#include <cmath>

#include "reckon/pdu/seconds.hpp"

namespace reckon::fuzz::unplugs {

class HeldHand {
 public:
  /// @param start [m, frame D], just in front of the wall
  explicit HeldHand(const Eigen::Vector3d& start) : start_(start), from_(start), to_(start) {}

  static constexpr double kGap = 0.001;  ///< [m]

  [[nodiscard]] const Eigen::Vector3d& start() const { return start_; }
  /// From `from` on it presses `depth` into the wall, then moves in and out.
  void press(const Eigen::Vector3d& from, double depth, std::chrono::nanoseconds now) {
    from_ = from;
    to_ = start_ - (kGap + depth) * Eigen::Vector3d::UnitZ();
    since_ = pdu::to_seconds(now);
  }
  /// The goal of the handle [m] at a time [s].
  [[nodiscard]] Eigen::Vector3d operator()(double t) const {
    constexpr double kWay = 0.03;     // [s]
    constexpr double kDepth = 0.002;  // [m], in and out
    const double share = std::clamp((t - since_) / kWay, 0.0, 1.0);
    const double smooth = share * share * (3 - 2 * share);
    const double sway = kDepth * std::sin(20 * (t - since_)) * smooth;
    return from_ + smooth * (to_ - from_) + sway * Eigen::Vector3d::UnitZ();
  }

 private:
  Eigen::Vector3d start_, from_, to_;
  double since_ = 0;
};

}  // namespace reckon::fuzz::unplugs
