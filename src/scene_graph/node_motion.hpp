// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The time function of a node: a closed form, so that every peer computes the same pose at the same
// time and nothing is sent.
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/scene_graph/node_pose.hpp"

namespace reckon::peer {

/// A node turns about an axis through its origin and swings along a line, either or both.
struct NodeMotion {
  Eigen::Vector3d turn_axis = Eigen::Vector3d::UnitZ();  ///< in the node's axes; any length > 0
  double turn_rate = 0.0;                                ///< [rad/s], right-handed about the axis
  Eigen::Vector3d swing = Eigen::Vector3d::Zero();       ///< amplitude [m], in the parent's axes
  double swing_rate = 0.0;                               ///< [Hz], >= 0
  double swing_phase = 0.0;                              ///< at time 0 [rad]

  /// Whether it moves at all.
  [[nodiscard]] bool moves() const noexcept {
    return turn_rate != 0.0 || (swing_rate != 0.0 && !swing.isZero(0.0));
  }
};

/// The fault of `motion` as a sentence; nothing: it is valid.
[[nodiscard]] inline std::optional<std::string> fault_of(const NodeMotion& motion) {
  const bool finite = motion.turn_axis.allFinite() && motion.swing.allFinite() &&
                      std::isfinite(motion.turn_rate) && std::isfinite(motion.swing_rate) &&
                      std::isfinite(motion.swing_phase);
  if (!finite) return "its motion is not finite";
  if (motion.turn_rate != 0.0 && motion.turn_axis.norm() < 1e-6)
    return "its axis of rotation has no direction: write one, such as [0, 0, 1]";
  if (motion.swing_rate < 0.0) return "its swing rate is below 0 Hz: negate the swing instead";
  return std::nullopt;
}

/// A pose in the parent and its rate.
struct MovedPose {
  NodePose pose;
  NodeVelocity velocity;  ///< in the parent's axes
};

/// The pose at `time` of a node whose pose without motion is `rest`:
///   position    rest.position + swing sin(2 pi swing_rate t + swing_phase)
///   orientation rest.orientation * R(turn_axis, turn_rate t)
/// and the derivatives of both. Some 60 ns.
[[nodiscard]] inline MovedPose moved(const NodePose& rest, const NodeMotion& motion,
                                     std::chrono::nanoseconds time) noexcept {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const double t = pdu::to_seconds(time);
  MovedPose now{rest, {}};
  if (motion.turn_rate != 0.0) {
    const Eigen::Vector3d axis = motion.turn_axis.normalized();
    now.pose.orientation =
        rest.orientation * Eigen::AngleAxisd(std::remainder(motion.turn_rate * t, kTurn), axis);
    now.velocity.angular = rest.orientation * (motion.turn_rate * axis);
  }
  const double cycles = motion.swing_rate * t;
  const double phase = kTurn * (cycles - std::floor(cycles)) + motion.swing_phase;
  now.pose.position += std::sin(phase) * motion.swing;
  now.velocity.linear = (kTurn * motion.swing_rate * std::cos(phase)) * motion.swing;
  return now;
}

}  // namespace reckon::peer
