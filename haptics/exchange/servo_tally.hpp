// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a servo has counted since its start: contact, forces that it showed smaller than asked, and
// steps that were not what they should be.
#pragma once

#include <cstdint>

namespace reckon::haptics {

/// For how long a force was shown smaller than asked, and where it lacked most.
struct Shortfall {
  /// What lacks less, of the force and in all, is nothing that a hand could feel.
  static constexpr double kLeastShare = 0.01;
  static constexpr double kLeastForce = 0.001;  // [N]

  double seconds = 0.0;  ///< [s], for which it was
  double share = 1.0;    ///< shown of `asked` where most newtons lacked
  double asked = 0.0;    ///< [N], there

  /// One step of `dt` [s]: of a force of `newtons` [N] this share in [0, 1] is shown.
  void note(double shown, double newtons, double dt) noexcept {
    const double lacks = (1.0 - shown) * newtons;
    if (!(lacks > kLeastForce) || !(1.0 - shown > kLeastShare)) return;
    seconds += dt;
    if (lacks <= (1.0 - share) * asked) return;
    share = shown;
    asked = newtons;
  }
  /// The same of a vector [N], measured only where some of it lacks.
  template <typename Force>
  void note_force(double shown, const Force& force, double dt) noexcept {
    if (1.0 - shown > kLeastShare) note(shown, force.norm(), dt);
  }
};

/// All since the start of the servo.
struct ServoTally {
  double hands = 0.0;   ///< [s] in contact with what others own
  double scene = 0.0;   ///< [s] in contact with the static scene
  Shortfall held_back;  ///< springs of hands, for lack of energy
  Shortfall crowd;      ///< springs of hands, which together are stiffer than the device can show
  /// The force as it is shown against that of springs as stiff as they were heard: energy is short
  /// for longer, and both ends show the contact softer.
  Shortfall softened;
  Shortfall rate;            ///< all forces: what grows or turns faster than the limit lags
  Shortfall walls;           ///< springs of the static scene, for lack of energy
  Shortfall effects;         ///< dampers and effects, for lack of energy
  Shortfall limit;           ///< all forces: more than the device, or the servo's setting, allows
  double refused = 0.0;      ///< [s] that a record near by could not be used
  std::uint64_t late = 0;    ///< steps that came more than half a period late
  std::uint64_t let_go = 0;  ///< steps that found that the device had dropped the force by itself
  std::uint64_t failed = 0;  ///< readings that failed
};

}  // namespace reckon::haptics
