// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The time function of a node: a closed form, so that every peer computes the same pose at the same
// time and nothing is sent.
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <optional>
#include <string>

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
  [[nodiscard]] bool moves() const noexcept;
};

/// The fault of `motion` as a sentence; nothing: it is valid.
[[nodiscard]] std::optional<std::string> fault_of(const NodeMotion& motion);

/// A pose in the parent and its rate.
struct MovedPose {
  NodePose pose;
  NodeVelocity velocity;  ///< in the parent's axes
};

/// The pose at `time` of a node whose pose without motion is `rest`:
///   position    rest.position + swing sin(2 pi swing_rate t + swing_phase)
///   orientation rest.orientation * R(turn_axis, turn_rate t)
/// and the derivatives of both. Some 60 ns.
[[nodiscard]] MovedPose moved(const NodePose& rest, const NodeMotion& motion,
                              std::chrono::nanoseconds time) noexcept;

}  // namespace reckon::peer
