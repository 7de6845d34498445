// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How long a heard state is extrapolated: what is frozen stands still, and past the time-out
// nothing is known any more.
#pragma once

#include <algorithm>
#include <chrono>

#include "reckon/deadreckon/motion/kinematic_state.hpp"
#include "reckon/pdu/seconds.hpp"

namespace reckon::peer {

/// The age of a state at one instant.
struct StateAge {
  double tau = 0;        ///< [s] to extrapolate by
  bool is_over = false;  ///< past the time-out: it holds rather than runs away

  /// @param since the state was true  @param timeout [s]
  StateAge(std::chrono::nanoseconds since, double timeout, bool frozen) noexcept
      : tau(frozen ? 0.0 : std::min(pdu::to_seconds(since), timeout)),
        is_over(pdu::to_seconds(since) > timeout) {}

  /// `pose` without its rates where it is over: what holds does not move.
  [[nodiscard]] deadreckon::Pose held(deadreckon::Pose pose) const noexcept {
    if (is_over) {
      pose.velocity.setZero();
      pose.angular_velocity.setZero();
    }
    return pose;
  }
};

}  // namespace reckon::peer
