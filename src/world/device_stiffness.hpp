// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The part of the scene's stiffness that a haptic device can show: fixed at the start and reported
// to the user.
#pragma once

#include <algorithm>
#include <limits>

namespace reckon::haptics {
class ServoLoop;
}

namespace reckon::peer {

struct HandModel;

/// Limits of one device, in [N/m] unless noted. "Asked" is the value of the scene file.
struct DeviceStiffness {
  static constexpr double kNoLimit = std::numeric_limits<double>::infinity();

  double walls_asked = 0.0;    ///< stiffest object of the scene, all its springs; 0: none
  double regions_asked = 0.0;  ///< stiffest region of the scene, all its potentials; 0: none
  double walls = kNoLimit;     ///< stiffest wall that is felt with it
  double regions = kNoLimit;   ///< stiffest region that is felt with it
  double hand_asked = 0.0;     ///< k1 of a hand of the scene
  double hand_k3 = 0.0;        ///< k3 [N/m^3] of a hand of the scene
  double hand_damping = 0.0;   ///< damping [N s/m] of a hand of the scene
  double hands = kNoLimit;    ///< stiffest felt hand, for both sides of a contact; without a damper
  double bodies = kNoLimit;   ///< stiffest entity without a hand, without a damper
  double force = kNoLimit;    ///< [N], largest force
  double damping = kNoLimit;  ///< [N s/m], of the device itself

  /// The part of a damper [N s/m] that is shown: at most half of the device's own.
  [[nodiscard]] double damper_shown(double damper) const noexcept {
    return std::min(damper, 0.5 * damping);
  }
  /// Share of `hands` and `bodies` that remains in addition to a damper, which uses up a part of
  /// the limit.
  [[nodiscard]] double left_beside(double damper) const noexcept {
    return damping > 0 ? 1.0 - damper_shown(damper) / damping : 1.0;
  }
  /// Largest stiffness at which a hand of the scene is felt, with its damper.
  [[nodiscard]] double hand_limit() const noexcept { return hands * left_beside(hand_damping); }
  [[nodiscard]] double walls_shown() const noexcept { return std::min(walls_asked, walls); }
  [[nodiscard]] double regions_shown() const noexcept { return std::min(regions_asked, regions); }
  [[nodiscard]] double hand_shown() const noexcept { return std::min(hand_asked, hand_limit()); }
  [[nodiscard]] bool softens_walls() const noexcept { return walls_asked > walls; }
  [[nodiscard]] bool softens_regions() const noexcept { return regions_asked > regions; }
  [[nodiscard]] bool softens_hand() const noexcept { return hand_asked > hand_limit(); }
  /// Depth [m] at which the slope of a hardening hand reaches the limit of the device, and from
  /// which it stays constant. Infinite if it never does.
  [[nodiscard]] double straight_from() const noexcept;
};

/// Limits of the device of `servo` for the servo's scene and its hand `hand`.
[[nodiscard]] DeviceStiffness stiffness_of(const haptics::ServoLoop& servo,
                                           const HandModel& hand) noexcept;

}  // namespace reckon::peer
