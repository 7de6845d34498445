// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a haptic device can show of what the scene asks: fixed at the start, told to the user.
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

  double walls_asked = 0.0;  ///< stiffest object of the scene, all its springs; 0: none
  double walls = kNoLimit;   ///< stiffest wall that is felt with it
  double hand_asked = 0.0;   ///< k1 of its hand
  double hand_k3 = 0.0;      ///< [N/m^3] of its hand
  double hands = kNoLimit;   ///< stiffest hand that is felt with it, and that its hand is to others
  double bodies = kNoLimit;  ///< stiffest entity that nobody holds
  double force = kNoLimit;   ///< [N], most that it can push

  [[nodiscard]] double walls_shown() const noexcept { return std::min(walls_asked, walls); }
  [[nodiscard]] double hand_shown() const noexcept { return std::min(hand_asked, hands); }
  [[nodiscard]] bool softens_walls() const noexcept { return walls_asked > walls; }
  [[nodiscard]] bool softens_hand() const noexcept { return hand_asked > hands; }
  /// Depth [m] at which the slope of a hand that hardens reaches what can be shown: from there on
  /// it stays. Infinite where it never does.
  [[nodiscard]] double straight_from() const noexcept;
};

/// What the device of `servo` shows of the servo's scene, and its hand of `hand`.
[[nodiscard]] DeviceStiffness stiffness_of(const haptics::ServoLoop& servo,
                                           const HandModel& hand) noexcept;

}  // namespace reckon::peer
