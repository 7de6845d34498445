// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Stick-slip friction with coefficients that vary over the surface, like cloth or wood grain: a
// texture that only resists motion, so it never needs energy. A scene file sets it with `grain =
// {..}` of an object.
#pragma once

#include <array>
#include <stdexcept>
#include <string_view>

#include "reckon/haptics/effects/effect_hooks.hpp"
#include "reckon/haptics/effects/effect_parameter.hpp"
#include "reckon/haptics/effects/effect_waves.hpp"
#include "reckon/haptics/geometry/friction_cone.hpp"

namespace reckon::haptics {

/// Both coefficients are multiplied by 1 + share * product of cos(2 pi p_i / wavelength_i).
struct Grain {
  double static_coefficient = 0.5;
  double kinetic_coefficient = 0.35;  ///< at most static_coefficient
  double share = 0.5;
  double wavelength_x = 0.0;  ///< [m], along the object's x axis; 0: constant along it
  double wavelength_y = 0.0;  ///< [m]
  double wavelength_z = 0.0;  ///< [m]
};

/// Holds the contact point back with the coefficient of its position.
class PlaceFriction : public CountedEffect<PlaceFriction> {
 public:
  using Parameters = Grain;
  static constexpr std::string_view kName = "place_friction";
  static constexpr std::string_view kKey = "grain";
  static constexpr std::string_view kCost = "one square root and a cosine for each wavelength";
  static constexpr std::array<EffectParameter<Grain>, 6> kParameters{{
      {"static", "", &Grain::static_coefficient, 0.0, 10.0, 0.5,
       "Mean tangential over normal force at which a resting contact starts to slide; higher "
       "sticks "
       "longer."},
      {"kinetic", "", &Grain::kinetic_coefficient, 0.0, 10.0, 0.35,
       "Mean tangential over normal force while sliding, at most the static value."},
      {"share", "", &Grain::share, 0.0, 1.0, 0.5,
       "Relative variation of both over the surface; higher feels rougher."},
      {"wavelength_x", "m", &Grain::wavelength_x, 0.0, 1.0, 0.0,
       "Distance of rough places along the object's x axis; 0 is even along it."},
      {"wavelength_y", "m", &Grain::wavelength_y, 0.0, 1.0, 0.0,
       "Distance of rough places along the object's y axis; 0 is even along it."},
      {"wavelength_z", "m", &Grain::wavelength_z, 0.0, 1.0, 0.0,
       "Distance of rough places along the object's z axis; 0 is even along it."},
  }};

  /// @throws std::invalid_argument when a value is out of range, or kinetic is above static.
  explicit PlaceFriction(const Grain& grain)
      : grain_(grain),
        waves_{{grain.wavelength_x, grain.wavelength_y, grain.wavelength_z}},
        cone_(grain.static_coefficient, grain.kinetic_coefficient) {
    check_parameters(kParameters, grain);
    if (grain.kinetic_coefficient > grain.static_coefficient) {
      throw std::invalid_argument(
          "grain: kinetic must not be above static; lower kinetic or raise static");
    }
  }

  /// Hook: the cone that holds the contact point.
  [[nodiscard]] FrictionCone& cone() noexcept { return cone_; }
  /// Hook: sets the coefficients of this position.
  void follow(const SlidingPlace& at) noexcept {
    const double factor = 1.0 + grain_.share * waves_.at(at.place);
    cone_.adjust(factor * grain_.static_coefficient, factor * grain_.kinetic_coefficient);
  }

  [[nodiscard]] const Grain& parameters() const noexcept { return grain_; }

 private:
  Grain grain_;
  EffectWaves waves_;
  FrictionCone cone_;
};

}  // namespace reckon::haptics
