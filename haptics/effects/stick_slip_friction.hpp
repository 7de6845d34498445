// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Stick-slip friction as a cone on the surface contact point (SCP): the SCP holds still until the
// tangential part of (device - SCP) passes the static share of the normal part, then slides until
// it is down to the kinetic share. Declared by `friction = {..}` of an object.
#pragma once

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string_view>

#include "reckon/haptics/effects/effect_parameter.hpp"

namespace reckon::haptics {

/// Stick-slip friction of a surface.
struct Friction {
  double static_coefficient = 0.5;
  double kinetic_coefficient = 0.35;  ///< at most static_coefficient
};

/// Passive: it only stops the SCP short of a goal, on a way along which |device - SCP| falls.
/// Holds whether the contact slides; one object per contact, servo thread only.
class StickSlipFriction : public CountedEffect<StickSlipFriction> {
 public:
  using Parameters = Friction;
  static constexpr std::string_view kName = "stick_slip_friction";
  static constexpr std::string_view kKey = "friction";
  static constexpr std::string_view kCost = "a square root a move";
  static constexpr std::array<EffectParameter<Friction>, 2> kParameters{{
      {"static", "", &Friction::static_coefficient, 0.0, 10.0, 0.5,
       "Tangential over normal force at which a resting contact starts to slide; higher sticks "
       "longer."},
      {"kinetic", "", &Friction::kinetic_coefficient, 0.0, 10.0, 0.35,
       "Tangential over normal force while sliding, at most the static value; a larger difference "
       "gives stronger stick-slip."},
  }};

  /// @throws std::invalid_argument when out of range, or kinetic above static.
  explicit StickSlipFriction(const Friction& friction) : friction_(friction) {
    check_parameters(kParameters, friction);
    if (friction.kinetic_coefficient > friction.static_coefficient) {
      throw std::invalid_argument(
          "friction: kinetic must not be above static; lower kinetic or raise static");
    }
  }

  /// Coefficient that holds now: static at rest, kinetic while sliding. Counted as a call.
  [[nodiscard]] double coefficient(bool sliding) noexcept {
    ++calls_;
    return sliding ? friction_.kinetic_coefficient : friction_.static_coefficient;
  }

  /// How far from its frictionless goal the SCP stays [m].
  /// @param lateral distance from the SCP to that goal [m]
  /// @param normal  summed normal displacement at the goal (force over stiffness) [m], >= 0
  [[nodiscard]] double held(double lateral, double normal, bool sliding) noexcept {
    if (lateral <= coefficient(sliding) * normal) return lateral;
    return friction_.kinetic_coefficient * normal;
  }

  [[nodiscard]] double kinetic() const noexcept { return friction_.kinetic_coefficient; }
  [[nodiscard]] bool sliding() const noexcept { return sliding_; }
  void set_sliding(bool sliding) noexcept { sliding_ = sliding; }
  /// Evaluations so far.
  [[nodiscard]] std::uint64_t calls() const noexcept { return calls_; }
  [[nodiscard]] const Friction& parameters() const noexcept { return friction_; }

 private:
  Friction friction_;
  std::uint64_t calls_ = 0;
  bool sliding_ = false;
};

}  // namespace reckon::haptics
