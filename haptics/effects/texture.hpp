// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Small bumps and grooves on a surface, as a force along it. A scene file sets it with
// `texture = {..}` of an object.
#pragma once

#include <Eigen/Core>
#include <array>
#include <stdexcept>
#include <string_view>

#include "reckon/haptics/effects/effect_hooks.hpp"
#include "reckon/haptics/effects/effect_parameter.hpp"
#include "reckon/haptics/effects/effect_slope.hpp"
#include "reckon/haptics/effects/effect_waves.hpp"

namespace reckon::haptics {

/// A height field over the object's axes: h = height * product of cos(2 pi p_i / wavelength_i).
struct TextureRelief {
  double height = 5e-5;       ///< [m]
  double wavelength_x = 0.0;  ///< [m], along the object's x axis; 0: constant along it
  double wavelength_y = 0.0;  ///< [m]
  double wavelength_z = 0.0;  ///< [m]
};

/// F = -N grad h along the surface, N the normal force: the force of the slope on a small ball. The
/// force is held, not booked as a potential: it is paid for like a damper, and stays full even if
/// its curvature N h'' exceeds the stiffness that the device can render. Waves that the hand
/// crosses in fewer than four samples fade, because they would give noise: at 1 kHz, waves of 1 mm
/// are rendered fully up to 0.25 m/s.
class Texture : public CountedEffect<Texture> {
 public:
  using Parameters = TextureRelief;
  static constexpr bool kInContactOnly = true;
  static constexpr std::string_view kName = "texture";
  static constexpr std::string_view kKey = "texture";
  static constexpr std::string_view kCost = "a sine and a cosine for each wavelength";
  static constexpr std::array<EffectParameter<TextureRelief>, 4> kParameters{{
      {"height", "m", &TextureRelief::height, 0.0, 1e-3, 5e-5,
       "Half the height between grooves and bumps; higher feels rougher."},
      {"wavelength_x", "m", &TextureRelief::wavelength_x, 0.0, 1.0, 0.0,
       "Distance of bumps along the object's x axis; 0 is even along it."},
      {"wavelength_y", "m", &TextureRelief::wavelength_y, 0.0, 1.0, 0.0,
       "Distance of bumps along the object's y axis; 0 is even along it."},
      {"wavelength_z", "m", &TextureRelief::wavelength_z, 0.0, 1.0, 0.0,
       "Distance of bumps along the object's z axis; 0 is even along it."},
  }};

  /// @throws std::invalid_argument when a value is out of the table's range, or a wavelength below
  /// ten heights: such slopes are too steep for a texture.
  explicit Texture(const TextureRelief& relief)
      : relief_(relief), waves_{{relief.wavelength_x, relief.wavelength_y, relief.wavelength_z}} {
    check_parameters(kParameters, relief);
    if (waves_.shortest() < 10.0 * relief.height) {
      throw std::invalid_argument(
          "texture: a wavelength is below ten times the height; lower the height or lengthen it");
    }
  }

  /// Hook: the force along the surface [N].
  [[nodiscard]] Eigen::Vector3d force(const EffectContact& contact) const noexcept {
    if (!contact.in_contact) return Eigen::Vector3d::Zero();
    const double shown = waves_.shown(contact.slip().norm() * contact.dt);
    if (!(shown > 0.0)) return Eigen::Vector3d::Zero();
    return shown * slope_force(contact, relief_.height * waves_.gradient(contact.object->place));
  }

  /// Hook: it reserves no damping.
  [[nodiscard]] double damping() const noexcept { return 0.0; }

  [[nodiscard]] const TextureRelief& parameters() const noexcept { return relief_; }

 private:
  TextureRelief relief_;
  EffectWaves waves_;
};

}  // namespace reckon::haptics
