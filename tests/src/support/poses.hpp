// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Poses on the x axis, moving or at rest.
#pragma once

#include "reckon/deadreckon/motion/drm.hpp"

namespace reckon::test {

/// @param x [m]
inline deadreckon::Pose at(double x) {
  deadreckon::Pose pose;
  pose.position = {x, 0, 0};
  return pose;
}

/// A state as it is sent. @param x [m] @param speed [m/s]; 0: static
inline deadreckon::KinematicState last_sent_at(double x, double speed = 0.0) {
  deadreckon::KinematicState state;
  state.position = {x, 0, 0};
  if (speed != 0.0) state.algorithm = pdu::DeadReckoningAlgorithm::fpw;
  state.velocity = {speed, 0, 0};
  return state;
}

}  // namespace reckon::test
