// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Friction that falls with the sliding speed, from stiction to Coulomb friction, and grows with it
// by viscosity (Stribeck curve): for lubricated surfaces, squeaking or smooth. A scene file sets it
// with `stribeck = {..}` of an object.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "reckon/haptics/effects/effect_hooks.hpp"
#include "reckon/haptics/effects/effect_parameter.hpp"
#include "reckon/haptics/geometry/friction_cone.hpp"

namespace reckon::haptics {

/// mu(v) = coulomb + (static - coulomb) exp(-(v / speed)^2) + viscous v.
struct Lubrication {
  double static_coefficient = 0.6;
  double coulomb = 0.3;  ///< at most static_coefficient
  double speed = 0.02;   ///< [m/s]
  double viscous = 0.0;  ///< [s/m], growth of the coefficient with speed
};

/// Holds the contact point back with the coefficient of its sliding speed, averaged over 10 ms: the
/// contact point has no mass, and would chatter with the speed of a single step. Where the
/// coefficient falls steeply, a slow hand feels stick-slip. The viscous part is implicit: the more
/// it holds the contact point back, the less the point slides in the same step.
class StribeckFriction : public CountedEffect<StribeckFriction> {
 public:
  using Parameters = Lubrication;
  static constexpr std::string_view kName = "stribeck_friction";
  static constexpr std::string_view kKey = "stribeck";
  static constexpr std::string_view kCost = "one square root and an exponential";
  static constexpr std::array<EffectParameter<Lubrication>, 4> kParameters{{
      {"static", "", &Lubrication::static_coefficient, 0.0, 10.0, 0.6,
       "Tangential over normal force at which a resting contact starts to slide; higher sticks "
       "longer."},
      {"coulomb", "", &Lubrication::coulomb, 0.0, 10.0, 0.3,
       "Tangential over normal force in fast sliding, at most the static value."},
      {"speed", "m/s", &Lubrication::speed, 1e-4, 1.0, 0.02,
       "Sliding speed at which a third of the difference remains; higher squeaks less."},
      {"viscous", "s/m", &Lubrication::viscous, 0.0, 100.0, 0.0,
       "Growth of the coefficient per m/s; higher slows fast strokes."},
  }};
  /// Greatest viscous part of the coefficient.
  static constexpr double kMostViscous = 10.0;

  /// @throws std::invalid_argument when a value is out of range, or coulomb is above static.
  explicit StribeckFriction(const Lubrication& lubrication)
      : lubrication_(lubrication),
        cone_(lubrication.static_coefficient, lubrication.static_coefficient) {
    check_parameters(kParameters, lubrication);
    if (lubrication.coulomb > lubrication.static_coefficient) {
      throw std::invalid_argument(
          "stribeck: coulomb must not be above static; lower coulomb or raise static");
    }
  }

  /// mu(v). @param slip v [m/s] >= 0
  [[nodiscard]] double coefficient(double slip) const noexcept {
    const double ratio = slip / lubrication_.speed;
    const double falling = lubrication_.static_coefficient - lubrication_.coulomb;
    return lubrication_.coulomb + falling * std::exp(-ratio * ratio) +
           std::min(lubrication_.viscous * slip, kMostViscous);
  }

  /// Hook: the cone that holds the contact point.
  [[nodiscard]] FrictionCone& cone() noexcept { return cone_; }
  /// Hook: sets the coefficient of this speed.
  void follow(const SlidingPlace& at) noexcept {
    if (at.began) slip_ = held_ = 0.0;
    const double per_slip = lubrication_.viscous * at.depth;  // [s], held back for each m/s
    const double before = std::exchange(held_, per_slip * slip_);
    // Sliding speed if viscosity held it back no more than before.
    const double free = std::max(0.0, at.slip + (held_ - before) / at.dt);
    const double share = std::min(1.0, at.dt / kLag);
    slip_ += share / (1.0 + share * per_slip / at.dt) * (free - slip_);
    const double kinetic = coefficient(slip_);
    cone_.adjust(std::max(kinetic, lubrication_.static_coefficient), kinetic);
  }

  [[nodiscard]] const Lubrication& parameters() const noexcept { return lubrication_; }

 private:
  static constexpr double kLag = 0.01;  // [s]

  Lubrication lubrication_;
  FrictionCone cone_;
  double slip_ = 0.0;  // [m/s]
  double held_ = 0.0;  // [m], distance by which viscosity held the contact point back
};

}  // namespace reckon::haptics
