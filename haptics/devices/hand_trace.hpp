// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Recorded hand motion as a smooth function of time.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "reckon/haptics/devices/simulated_device.hpp"

namespace reckon::haptics {

/// What to do with the recorded positions. First fit_to, then scale about the centre, then offset.
struct HandTraceOptions {
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< [m], added last
  double scale = 1.0;                                ///< > 0
  /// Centres the motion in this box [m] and shrinks it (all axes alike) until it fits.
  std::optional<Eigen::AlignedBox3d> fit_to;
  bool loop = true;         ///< starts again at the end; else holds the last position
  double loop_blend = 0.5;  ///< [s] > 0, duration of the smooth return from the end to the start
};

/// Positions over time, interpolated C1 (Catmull-Rom for uneven times): recordings at 83 to 103 Hz
/// give a hand that a 1 kHz servo feels as smooth. Immutable; any thread.
class HandTrace {
 public:
  /// Times [s] and as many positions [m], at least one. @throws std::invalid_argument unless times
  /// grow strictly, or with options out of their range.
  HandTrace(std::vector<double> times, std::vector<Eigen::Vector3d> positions,
            const HandTraceOptions& options = {});

  /// Position and velocity at a time [s] since the start; before 0 the start. O(log n).
  [[nodiscard]] HandTarget at(double time) const noexcept;

  /// [s], of one round: the recording and, if looping, the return.
  [[nodiscard]] double duration() const noexcept { return knots_.back().time; }
  [[nodiscard]] Eigen::AlignedBox3d bounds() const noexcept;

 private:
  struct Knot {
    double time;               // [s], the first is 0
    Eigen::Vector3d position;  // [m]
    Eigen::Vector3d velocity;  // [m/s]
  };
  void build(const std::vector<double>& times, const std::vector<Eigen::Vector3d>& positions,
             const HandTraceOptions& options);

  std::vector<Knot> knots_;
  bool loop_ = true;
};

}  // namespace reckon::haptics
