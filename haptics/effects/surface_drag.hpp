// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Viscous drag along a surface, like a film of oil. A scene file sets it with `drag = {..}` of an
// object.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "reckon/haptics/effects/effect_hooks.hpp"
#include "reckon/haptics/effects/effect_parameter.hpp"

namespace reckon::haptics {

/// Parameters of a film on a surface.
struct Film {
  double viscosity = 2.0;  ///< [N s/m]
};

/// F = -viscosity times the velocity along the surface, while in contact, at any pressure. For a
/// body the viscosity is at most 0.3 m_eff / T, with its least effective mass m_eff
/// (least_mass.hpp): a light body reaches the hand's speed within a few periods. It grows and fades
/// within about 5 ms at the start and end of a contact, and restarts where the surface turns, as at
/// an edge.
class SurfaceDrag : public CountedEffect<SurfaceDrag> {
 public:
  using Parameters = Film;
  static constexpr bool kInContactOnly = true;
  static constexpr std::string_view kName = "surface_drag";
  static constexpr std::string_view kKey = "drag";
  static constexpr std::string_view kCost = "a few multiplications";
  static constexpr std::array<EffectParameter<Film>, 1> kParameters{{
      {"viscosity", "N s/m", &Film::viscosity, 0.0, 100.0, 2.0,
       "Force against motion along the surface, per m/s; higher feels stickier and takes stiffness "
       "from the walls, at most half of it."},
  }};

  /// @throws std::invalid_argument when the value is out of the table's range.
  explicit SurfaceDrag(const Film& film) : film_(film) { check_parameters(kParameters, film); }

  /// Hook: the drag [N].
  [[nodiscard]] Eigen::Vector3d force(const EffectContact& contact) noexcept {
    if (!contact.in_contact) return Eigen::Vector3d::Zero();
    if (!std::isfinite(contact.most_viscosity)) return -film_.viscosity * contact.slip();
    return -share_of(contact) * std::min(film_.viscosity, contact.most_viscosity) * contact.slip();
  }

  /// Hook: its coefficient [N s/m].
  [[nodiscard]] double damping() const noexcept { return film_.viscosity; }

  [[nodiscard]] const Film& parameters() const noexcept { return film_; }

 private:
  static constexpr double kBegin = 0.005;  // [s]

  [[nodiscard]] double share_of(const EffectContact& contact) noexcept {
    begun_ = contact.object->began ? 0.0 : begun_ * std::max(0.0, normal_.dot(contact.normal));
    begun_ += std::min(1.0, contact.dt / kBegin) * (1.0 - begun_);
    normal_ = contact.normal;
    const double parting = kBegin * contact.relative().dot(contact.normal);  // [m]
    return parting > 0 ? -std::expm1(-contact.depth / parting) * begun_ : begun_;
  }

  Film film_;
  double begun_ = 0.0;                                // share of the viscosity, for a body
  Eigen::Vector3d normal_ = Eigen::Vector3d::Zero();  // normal in the last step
};

}  // namespace reckon::haptics
