// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The motion that an owner sends for an entity, and the pose that all peers compute from it.
#pragma once

#include <Eigen/Geometry>

#include "reckon/pdu/codec/enumerations.hpp"

namespace reckon::deadreckon {

/// The motion of an entity at the instant of an update: the predictor of its pose.
///
/// Quantities are in one "reference" frame, which the caller chooses (Reckon uses the scene frame
/// S, metres), or in the entity's body frame B (x forward, y right, z down). SI units.
struct KinematicState {
  /// The terms of the prediction, and whether velocity is in reference or body axes.
  pdu::DeadReckoningAlgorithm algorithm = pdu::DeadReckoningAlgorithm::static_;
  /// Origin of B, reference axes [m].
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  /// Unit quaternion, body to reference: v_S = q * v_B.
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  /// [m/s]; reference axes for DRM 2 to 5, body axes for DRM 6 to 9.
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  /// [m/s^2]; the same axes as velocity. In body axes it is the rate of the velocity's components.
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();
  /// [rad/s], body axes for every DRM.
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();
};

/// Pose of an entity at one time, from any model.
struct Pose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();               ///< Reference axes [m].
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< Unit, body to reference.
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();               ///< Reference axes [m/s].
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();       ///< Body axes [rad/s].
};

/// Whether every number of `state` is finite and its quaternion has length 1 within 1e-6.
[[nodiscard]] bool is_finite(const KinematicState& state) noexcept;

/// Whether every number of `pose` is finite.
[[nodiscard]] bool is_finite(const Pose& pose) noexcept;

}  // namespace reckon::deadreckon
