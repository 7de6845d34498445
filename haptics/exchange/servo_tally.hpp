// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Counts of a servo since its start: contact time, forces shown smaller than wanted, and faulty
// steps.
#pragma once

#include <cstdint>

namespace reckon::haptics {

/// Time in which a force was shown smaller than wanted, and the case with the greatest lack.
struct Shortfall {
  /// A smaller lack, relative and absolute, cannot be felt.
  static constexpr double kLeastShare = 0.01;
  static constexpr double kLeastForce = 0.001;  // [N]

  double seconds = 0.0;  ///< [s], duration
  double share = 1.0;    ///< shown share of `asked` in the case with the greatest lack in newtons
  double asked = 0.0;    ///< [N], wanted in that case

  /// Counts one step of `dt` [s] that shows the share `shown` in [0, 1] of a force of `newtons`
  /// [N].
  void note(double shown, double newtons, double dt) noexcept {
    const double lacks = (1.0 - shown) * newtons;
    if (!(lacks > kLeastForce) || !(1.0 - shown > kLeastShare)) return;
    seconds += dt;
    if (lacks <= (1.0 - share) * asked) return;
    share = shown;
    asked = newtons;
  }
  /// The same for a vector [N], whose size is computed only if some of it lacks.
  void note_force(double shown, const auto& force, double dt) noexcept {
    if (1.0 - shown > kLeastShare) note(shown, force.norm(), dt);
  }
};

/// Totals since the start of the servo.
struct ServoTally {
  double hands = 0.0;      ///< [s] in contact with remote hands and bodies
  double scene = 0.0;      ///< [s] in contact with the static scene
  double bodies = 0.0;     ///< [s] in contact with bodies that other peers move
  double at_bodies = 0.0;  ///< [s] in contact with bodies of any owner
  /// [J], put into bodies and springs, minus what came back; 0 in a scene without bodies.
  double body_energy = 0.0;
  double grabbed = 0.0;  ///< [s] in which it held a body
  Shortfall held_back;   ///< springs of hands, for lack of energy
  Shortfall guests;      ///< springs of guests beside hands, which come first (GuestShare)
  Shortfall crowd;       ///< springs of hands that are together stiffer than the device can render
  /// The shown force against the force of springs at their received stiffness: energy has been
  /// short for longer, and both ends show the contact softer.
  Shortfall softened;
  Shortfall rate;          ///< all forces that grow or rotate faster than the limit
  Shortfall walls;         ///< springs of the static scene, for lack of energy
  Shortfall effects;       ///< dampers and effects, for lack of energy
  Shortfall limit;         ///< all forces: more than the device, or the servo's setting, allows
  double hidden = 0.0;     ///< [m], greatest depth of a wall that no loan could pay for
  double refused = 0.0;    ///< [s] in which a nearby record could not be used
  std::uint64_t late = 0;  ///< steps more than half a period late
  std::uint64_t force_drops = 0;  ///< steps in which the device had dropped the force by itself
  std::uint64_t failed = 0;       ///< readings that failed
  double stopped = 0.0;           ///< [s] in which the software stop held the force at zero
  std::uint32_t stops = 0;        ///< times that the software stop began
  std::uint32_t passed = 0;       ///< objects that moved through the hand with more than its force
};

}  // namespace reckon::haptics
