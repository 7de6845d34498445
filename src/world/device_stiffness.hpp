// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a haptic device can show of what the scene asks: fixed at the start, reported to the user.
#pragma once

#include <algorithm>
#include <limits>

namespace reckon::haptics {
class ServoLoop;
}

namespace reckon::peer {

struct HandModel;

/// Of one device. [N/m] unless said; "asked" is what the scene file says.
struct DeviceStiffness {
  static constexpr double kNoLimit = std::numeric_limits<double>::infinity();

  double walls_asked = 0.0;   ///< stiffest object of the scene, all its springs; 0: none
  double walls = kNoLimit;    ///< stiffest wall that is felt with it
  double hand_asked = 0.0;    ///< k1 of a hand of the scene
  double hand_k3 = 0.0;       ///< [N/m^3] of such
  double hand_damping = 0.0;  ///< [N s/m] of such
  double hands = kNoLimit;    ///< stiffest hand without a damper; no stiffer is its own to others
  double bodies = kNoLimit;   ///< stiffest entity that nobody holds, without a damper
  double force = kNoLimit;    ///< [N], most that it can push
  double damping = kNoLimit;  ///< [N s/m], its own

  /// Of a damper [N s/m]: as much as is shown, at most half of the device's own.
  [[nodiscard]] double damper_shown(double damper) const noexcept {
    return std::min(damper, 0.5 * damping);
  }
  /// Share of `hands` and `bodies` that is left beside a damper: what damps cannot carry a spring.
  [[nodiscard]] double left_beside(double damper) const noexcept {
    return damping > 0 ? 1.0 - damper_shown(damper) / damping : 1.0;
  }
  /// Stiffest that a hand of the scene is felt, with its damper.
  [[nodiscard]] double hand_limit() const noexcept { return hands * left_beside(hand_damping); }
  [[nodiscard]] double walls_shown() const noexcept { return std::min(walls_asked, walls); }
  [[nodiscard]] double hand_shown() const noexcept { return std::min(hand_asked, hand_limit()); }
  [[nodiscard]] bool softens_walls() const noexcept { return walls_asked > walls; }
  [[nodiscard]] bool softens_hand() const noexcept { return hand_asked > hand_limit(); }
  /// Depth [m] at which the slope of a hand that hardens reaches what can be shown: from there on
  /// it stays. Infinite where it never does.
  [[nodiscard]] double straight_from() const noexcept;
};

/// What the device of `servo` shows of the servo's scene, and its hand of `hand`.
[[nodiscard]] DeviceStiffness stiffness_of(const haptics::ServoLoop& servo,
                                           const HandModel& hand) noexcept;

}  // namespace reckon::peer
