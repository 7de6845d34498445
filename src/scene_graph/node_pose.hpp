// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The pose of a node in its parent, composition of poses, and their velocities.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace reckon::peer {

/// A frame in another one, A in B: p_B = position + orientation * (scale * p_A).
struct alignas(64) NodePose {                                       // one cache line
  Eigen::Vector3d position = Eigen::Vector3d::Zero();               ///< of A's origin [m], B
  double scale = 1.0;                                               ///< of lengths in A; > 0
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< A -> B, of length 1

  /// p_B of a point of A.
  [[nodiscard]] Eigen::Vector3d operator*(const Eigen::Vector3d& point) const noexcept {
    return position + orientation * (scale * point);
  }
};

/// `inner` is a pose in A, `outer` the pose of A in B; returns the pose in B.
[[nodiscard]] inline NodePose placed(const NodePose& outer, const NodePose& inner) noexcept {
  return {outer * inner.position, outer.scale * inner.scale, outer.orientation * inner.orientation};
}

/// Velocity of a frame in another one, B; its scale is constant.
struct NodeVelocity {
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();   ///< of the frame's origin [m/s], B
  Eigen::Vector3d angular = Eigen::Vector3d::Zero();  ///< [rad/s], B

  /// Velocity of the point of the frame that is `offset` [m, B] from its origin [m/s].
  [[nodiscard]] Eigen::Vector3d at(const Eigen::Vector3d& offset) const noexcept {
    return linear + angular.cross(offset);
  }
};

/// Velocity of A in C: A moves by `inner` in B at the position `position` [m]; B has the pose
/// `outer` in C and moves there by `moves`.
[[nodiscard]] inline NodeVelocity carried(const NodePose& outer, const NodeVelocity& moves,
                                          const Eigen::Vector3d& position,
                                          const NodeVelocity& inner) noexcept {
  const Eigen::Vector3d offset = outer.orientation * (outer.scale * position);
  return {moves.at(offset) + outer.orientation * (outer.scale * inner.linear),
          moves.angular + outer.orientation * inner.angular};
}

}  // namespace reckon::peer
