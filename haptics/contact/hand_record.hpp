// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Checks of received records of remote hands.
#pragma once

#include <algorithm>
#include <cmath>

#include "reckon/haptics/exchange/servo_types.hpp"

namespace reckon::haptics {

/// Whether its numbers are usable in a servo.
[[nodiscard]] inline bool is_sound(const RemoteHand& hand) {
  return deadreckon::is_finite(hand.state) && hand.model.point.allFinite() &&
         hand.model.normal.allFinite() && std::isfinite(hand.model.damping) &&
         hand.model.damping >= 0;
}

/// Whether the spring's parameters differ, ignoring its position.
[[nodiscard]] inline bool is_reshaped(const deadreckon::ForceModel& from,
                                      const deadreckon::ForceModel& to) {
  const auto differs = [](double a, double b) { return std::abs(b - a) > 0.01 * std::max(a, b); };
  return differs(from.k1, to.k1) || differs(from.k3, to.k3) || differs(from.radius, to.radius) ||
         differs(from.static_friction, to.static_friction) ||
         differs(from.kinetic_friction, to.kinetic_friction);
}

}  // namespace reckon::haptics
