// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a rule about sending looks at: by how much peers are wrong, and what they may be wrong by.
#pragma once

#include "reckon/deadreckon/motion/kinematic_state.hpp"

namespace reckon::deadreckon {

/// The errors that peers may see before an update is sent. The only accuracy knobs of a user:
/// smaller means more packets.
struct Thresholds {
  double position = 1.0;  ///< True distance [m], a sphere; the standard's default. 1e-4 and up.
  double angle = 0.05235987755982989;  ///< True angle [rad]; the standard's default, 3 degrees.
  double force = 0.1;                  ///< [N], at the places that are touched.
  /// Share of the true force that may be missing too, 0 to 1: people notice 0.07 to 0.1. The larger
  /// of both counts. Default 0: newtons alone.
  double weber = 0;
  double speed_allowance = 0;  ///< Rule velocity_aware: seconds of speed, >= 0.
  double viewer_distance = 0;  ///< Rule seen_from: of the nearest viewer [m], >= 0.
  /// Rule seen_from [rad]: what the eye resolves. Default 2.9e-4, one minute of arc.
  double visual_angle = 2.908882086657216e-4;
};

/// Fingertips tell two points apart from about this distance on [m]: a threshold for what is
/// touched without being held.
inline constexpr double kFingertipResolution = 2.5e-3;

/// By how much a prediction is off, reference axes.
struct PoseError {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();       ///< True minus predicted [m].
  Eigen::Vector3d true_velocity = Eigen::Vector3d::Zero();  ///< [m/s]
};

}  // namespace reckon::deadreckon
