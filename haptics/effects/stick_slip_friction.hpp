// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Stick-slip friction as a cone on the surface contact point (SCP), see friction_cone.hpp. A scene
// file sets it with `friction = {..}` of an object.
#pragma once

#include <array>
#include <stdexcept>
#include <string_view>

#include "reckon/haptics/effects/effect_parameter.hpp"
#include "reckon/haptics/geometry/friction_cone.hpp"

namespace reckon::haptics {

/// Stick-slip friction of a surface.
struct Friction {
  double static_coefficient = 0.5;
  double kinetic_coefficient = 0.35;  ///< at most static_coefficient
};

/// Holds the contact point back while the hand moves on. The spring between them then renders the
/// friction force.
class StickSlipFriction : public CountedEffect<StickSlipFriction> {
 public:
  using Parameters = Friction;
  static constexpr std::string_view kName = "stick_slip_friction";
  static constexpr std::string_view kKey = "friction";
  static constexpr std::string_view kCost = "one square root for each move";
  static constexpr std::array<EffectParameter<Friction>, 2> kParameters{{
      {"static", "", &Friction::static_coefficient, 0.0, 10.0, 0.5,
       "Tangential over normal force at which a resting contact starts to slide; higher sticks "
       "longer."},
      {"kinetic", "", &Friction::kinetic_coefficient, 0.0, 10.0, 0.35,
       "Tangential over normal force while sliding, at most the static value; a larger difference "
       "gives stronger stick-slip."},
  }};

  /// @throws std::invalid_argument when a coefficient is out of range, or kinetic is above static.
  explicit StickSlipFriction(const Friction& friction)
      : friction_(friction), cone_(friction.static_coefficient, friction.kinetic_coefficient) {
    check_parameters(kParameters, friction);
    if (friction.kinetic_coefficient > friction.static_coefficient) {
      throw std::invalid_argument(
          "friction: kinetic must not be above static; lower kinetic or raise static");
    }
  }

  /// Effect hook: the cone that holds the contact point.
  [[nodiscard]] FrictionCone& cone() noexcept { return cone_; }

  [[nodiscard]] const Friction& parameters() const noexcept { return friction_; }

  /// Changes the coefficients, which must be in range. A sliding contact keeps sliding.
  void adjust(const Friction& friction) noexcept {
    friction_ = friction;
    cone_.adjust(friction.static_coefficient, friction.kinetic_coefficient);
  }

 private:
  Friction friction_;
  FrictionCone cone_;
};

}  // namespace reckon::haptics
