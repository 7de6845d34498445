// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The virtual coupling of every surface: a spring from the device point to its surface contact
// point (SCP), and a damper along the surface normal. A scene file sets it with `surface = {..}` of
// an object.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <string_view>

#include "reckon/haptics/effects/effect_hooks.hpp"
#include "reckon/haptics/effects/effect_parameter.hpp"

namespace reckon::haptics {

/// Parameters of a surface.
struct Surface {
  double stiffness = 800.0;  ///< [N/m]
  double damping = 0.0;      ///< [N s/m], along the surface normal
};

/// F = k (p_scp - p_device). The damper is separate, because only the spring stores energy. Passive
/// for a sampled device with damping b if k <= 2 b / T (thesis eq (3.8)). Every object that can be
/// touched has it.
class SpringDamper : public CountedEffect<SpringDamper> {
 public:
  using Parameters = Surface;
  static constexpr bool kAlways = true;
  static constexpr bool kInContactOnly = true;
  static constexpr std::string_view kName = "spring_damper";
  static constexpr std::string_view kKey = "surface";
  static constexpr std::string_view kCost = "a few multiplications";
  static constexpr std::array<EffectParameter<Surface>, 2> kParameters{{
      {"stiffness", "N/m", &Surface::stiffness, 0.0, 1e6, 800.0,
       "Force per metre between the device and its surface contact point; higher feels harder and "
       "needs more damping in the device to stay passive."},
      {"damping", "N s/m", &Surface::damping, 0.0, 1e4, 0.0,
       "Force against motion along the surface normal while in contact, per m/s; higher calms the "
       "contact until velocity noise is felt."},
  }};

  /// @throws std::invalid_argument when a value is out of the table's range.
  explicit SpringDamper(const Surface& surface) : surface_(surface) {
    check_parameters(kParameters, surface);
  }

  /// Hook: force on the device [N]; both points [m] in one frame.
  [[nodiscard]] Eigen::Vector3d spring_force(const Eigen::Vector3d& scp,
                                             const Eigen::Vector3d& device) const noexcept {
    return surface_.stiffness * (scp - device);
  }

  /// Hook: energy held by the spring [J]: 1/2 k |device - scp|^2.
  [[nodiscard]] double stored_energy(const Eigen::Vector3d& scp,
                                     const Eigen::Vector3d& device) const noexcept {
    return 0.5 * surface_.stiffness * (scp - device).squaredNorm();
  }

  /// Hook: stiffness of the spring [N/m].
  [[nodiscard]] double stiffness() const noexcept { return surface_.stiffness; }

  /// Hook: the damper [N], -damping (v.n) n while in contact, with at most the contact's
  /// most_viscosity. It is limited so that the sum with the spring never pulls the hand to the
  /// surface. Its power on the device is never positive.
  [[nodiscard]] Eigen::Vector3d force(const EffectContact& contact) const noexcept {
    if (!contact.in_contact) return Eigen::Vector3d::Zero();
    const Eigen::Vector3d& normal = contact.normal;
    const double pull_limit = -std::max(contact.spring.dot(normal), 0.0);
    const double damping = std::min(surface_.damping, contact.most_viscosity);
    return std::max(-damping * contact.velocity.dot(normal), pull_limit) * normal;
  }

  /// Hook: the damper's coefficient [N s/m].
  [[nodiscard]] double damping() const noexcept { return surface_.damping; }

  [[nodiscard]] const Surface& parameters() const noexcept { return surface_; }

  /// Changes the values, which must be in range.
  void adjust(const Surface& surface) noexcept { surface_ = surface; }

 private:
  Surface surface_;
};

}  // namespace reckon::haptics
