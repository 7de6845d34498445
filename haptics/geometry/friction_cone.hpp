// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The friction cone that holds a surface contact point (SCP). The SCP rests until the tangential
// part of (device - SCP) exceeds the static coefficient times the normal part. Then it slides until
// that ratio is down to the kinetic coefficient.
#pragma once

#include <cstdint>

namespace reckon::haptics {

/// Passive: it only stops the SCP before its goal, on a path along which |device - SCP| decreases.
/// Stores whether the contact slides. One object for each contact; servo thread only.
class FrictionCone {
 public:
  /// Tangential over normal, both >= 0; kinetic is at most static.
  FrictionCone(double static_coefficient, double kinetic_coefficient) noexcept
      : static_(static_coefficient), kinetic_(kinetic_coefficient) {}

  /// Present coefficient: static at rest, kinetic while sliding. Counts the call.
  [[nodiscard]] double coefficient(bool sliding) noexcept {
    ++calls_;
    return sliding ? kinetic_ : static_;
  }

  /// Distance that the SCP keeps from its frictionless goal [m].
  /// @param lateral distance from the SCP to that goal [m]
  /// @param normal  summed normal displacement at the goal (force over stiffness) [m], >= 0
  [[nodiscard]] double held(double lateral, double normal, bool sliding) noexcept {
    if (lateral <= coefficient(sliding) * normal) return lateral;
    return kinetic_ * normal;
  }

  /// Changes the coefficients; ranges as in the constructor.
  void adjust(double static_coefficient, double kinetic_coefficient) noexcept {
    static_ = static_coefficient;
    kinetic_ = kinetic_coefficient;
  }

  [[nodiscard]] double at_rest() const noexcept { return static_; }
  [[nodiscard]] double kinetic() const noexcept { return kinetic_; }
  [[nodiscard]] bool sliding() const noexcept { return sliding_; }
  void set_sliding(bool sliding) noexcept { sliding_ = sliding; }
  /// Evaluations so far.
  [[nodiscard]] std::uint64_t calls() const noexcept { return calls_; }

 private:
  double static_;
  double kinetic_;
  std::uint64_t calls_ = 0;
  bool sliding_ = false;
};

}  // namespace reckon::haptics
