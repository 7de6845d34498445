// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The cone that holds a surface contact point (SCP): it rests until the tangential part of (device
// - SCP) passes the static share of the normal part, then slides until it is down to the kinetic
// share.
#pragma once

#include <cstdint>

namespace reckon::haptics {

/// Passive: it only stops the SCP short of a goal, on a way along which |device - SCP| falls.
/// Holds whether the contact slides; one object per contact, servo thread only.
class FrictionCone {
 public:
  /// Tangential over normal, both >= 0; kinetic is at most static.
  FrictionCone(double static_coefficient, double kinetic_coefficient) noexcept
      : static_(static_coefficient), kinetic_(kinetic_coefficient) {}

  /// Coefficient that holds now: static at rest, kinetic while sliding. Counted as a call.
  [[nodiscard]] double coefficient(bool sliding) noexcept {
    ++calls_;
    return sliding ? kinetic_ : static_;
  }

  /// How far from its frictionless goal the SCP stays [m].
  /// @param lateral distance from the SCP to that goal [m]
  /// @param normal  summed normal displacement at the goal (force over stiffness) [m], >= 0
  [[nodiscard]] double held(double lateral, double normal, bool sliding) noexcept {
    if (lateral <= coefficient(sliding) * normal) return lateral;
    return kinetic_ * normal;
  }

  /// Other coefficients from now on, as in the constructor.
  void adjust(double static_coefficient, double kinetic_coefficient) noexcept {
    static_ = static_coefficient;
    kinetic_ = kinetic_coefficient;
  }

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
