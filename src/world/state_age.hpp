// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Limits the extrapolation of a received state: a frozen entity does not move, a doubted one comes
// to rest, and after the time-out nothing is known any more.
#pragma once

#include <algorithm>
#include <chrono>

#include "reckon/deadreckon/motion/kinematic_state.hpp"
#include "reckon/pdu/seconds.hpp"

namespace reckon::peer {

/// The age of a state at one instant.
struct StateAge {
  /// [s] in which a doubted entity comes to rest. Meanwhile it covers the same distance as with its
  /// full speed in half of that time.
  static constexpr double kSlowing = 0.5;

  double tau = 0;    ///< [s] to extrapolate by
  double speed = 1;  ///< share of its rates at which it moves, 1 to 0 without a step

  /// @param since the state was true  @param timeout [s]
  /// @param doubted since its owner is doubted, 0 or less if it is not
  StateAge(std::chrono::nanoseconds since, double timeout, bool frozen,
           std::chrono::nanoseconds doubted = {}) noexcept {
    const double age = pdu::to_seconds(since);
    const double slowed = std::max(0.0, pdu::to_seconds(doubted));
    const double x = std::min(slowed / kSlowing, 1.0);
    speed = age > timeout ? 0.0 : (1 - x) * (1 - x) * (1 + 2 * x);
    // The integral of that.
    const double went = kSlowing * (x - x * x * x + 0.5 * x * x * x * x);
    tau = frozen ? 0.0 : std::min(age - slowed + went, timeout);
  }

  /// Scales the rates of `pose` to the share that is left: a resting entity has none.
  void hold(deadreckon::Pose& pose) const noexcept {
    if (speed < 1) {
      pose.velocity *= speed;
      pose.angular_velocity *= speed;
    }
  }
};

}  // namespace reckon::peer
