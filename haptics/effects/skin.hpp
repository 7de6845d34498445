// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A skin that can be pierced: it adds to the surface's stiffness until then, and heals when the tip
// is out again. A scene file sets it with `skin = {..}` of an object.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string_view>

#include "reckon/haptics/effects/effect_hooks.hpp"
#include "reckon/haptics/effects/effect_parameter.hpp"

namespace reckon::haptics {

/// Parameters of a skin over a softer body.
struct Membrane {
  double stiffness = 400.0;  ///< [N/m], in addition to the surface's
  double force = 1.0;        ///< [N], of the skin alone, at which it breaks
};

/// A second spring beside the surface's. Its energy is lost when it breaks.
class Skin : public CountedEffect<Skin> {
 public:
  using Parameters = Membrane;
  static constexpr bool kInContactOnly = true;
  static constexpr std::string_view kName = "skin";
  static constexpr std::string_view kKey = "skin";
  static constexpr std::string_view kCost = "a few multiplications";
  static constexpr std::array<EffectParameter<Membrane>, 2> kParameters{{
      {"stiffness", "N/m", &Membrane::stiffness, 1.0, 1e6, 400.0,
       "Force per metre, added to the surface's; higher feels tighter."},
      {"force", "N", &Membrane::force, 0.01, 20.0, 1.0,
       "Force at which the skin yields; higher is tougher."},
  }};

  /// @throws std::invalid_argument when a value is out of the table's range.
  explicit Skin(const Membrane& membrane) : membrane_(membrane) {
    check_parameters(kParameters, membrane);
  }

  /// Hook: force on the device [N]; both points [m] in one frame.
  [[nodiscard]] Eigen::Vector3d spring_force(const Eigen::Vector3d& scp,
                                             const Eigen::Vector3d& device) const noexcept {
    return stiffness() * (scp - device);
  }
  /// Hook: energy held [J].
  [[nodiscard]] double stored_energy(const Eigen::Vector3d& scp,
                                     const Eigen::Vector3d& device) const noexcept {
    return 0.5 * stiffness() * (scp - device).squaredNorm();
  }
  /// Hook: stiffness of the spring [N/m]; 0 while pierced.
  [[nodiscard]] double stiffness() const noexcept { return pierced_ ? 0.0 : membrane_.stiffness; }

  /// Hook: breaks or heals the skin; gives no force itself [N].
  [[nodiscard]] Eigen::Vector3d force(const EffectContact& contact) noexcept {
    const auto breaks = [&] {
      return contact.object->gain * membrane_.stiffness * contact.depth > membrane_.force;
    };
    pierced_ = contact.in_contact && (pierced_ || breaks());
    return Eigen::Vector3d::Zero();
  }
  /// Hook: it reserves no damping.
  [[nodiscard]] double damping() const noexcept { return 0.0; }

  [[nodiscard]] const Membrane& parameters() const noexcept { return membrane_; }

 private:
  Membrane membrane_;
  bool pierced_ = false;
};

}  // namespace reckon::haptics
