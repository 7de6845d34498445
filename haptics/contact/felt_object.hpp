// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One object of a plan at one probe: its effects, and their state of the contact.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "reckon/haptics/contact/contact_result.hpp"
#include "reckon/haptics/contact/mesh_stroke.hpp"
#include "reckon/haptics/contact/patch_blend.hpp"
#include "reckon/haptics/geometry/surface_contact_point.hpp"
#include "reckon/haptics/scene/effect_plan.hpp"

namespace reckon::haptics {

/// Its springs and other effects at one probe. ContactSolver decides where the contact is.
struct FeltObject {
  FeltObject(const PlannedEffects& planned, double radius);

  SurfaceContactPoint point;  ///< while only this object is within reach
  PlannedEffects effects;
  bool started_inside = false;
  PatchBlend blend{};                                 ///< for a mesh with patches
  std::uint64_t touched_at = 0;                       ///< step of the last touch; 0: none
  Eigen::Vector3d held_at = Eigen::Vector3d::Zero();  ///< end of its springs, in its own axes
  Eigen::Vector3d place =
      Eigen::Vector3d::Zero();  ///< position of the SCP, for effects that follow it
  bool follows = false;         ///< it has an effect that follows the SCP
  MeshStroke stroke{};          ///< on a mesh, for effects with a force
  bool began = false;           ///< its contact is new in this step
  double hidden = 0.0;          ///< [m], hidden part of the depth

  /// Friction cone that holds the contact point; null for a smooth surface.
  [[nodiscard]] FrictionCone* cone() noexcept;
  /// Stiffness of all its springs together [N/m].
  [[nodiscard]] double stiffness() const noexcept;

  /// Restores the state before any contact.
  void restart(const PlannedEffects& planned) noexcept;
  /// Marks it as touched in this step.
  void touch(std::uint64_t step) noexcept;
  /// Takes the properties of the surface below the contact point.
  void adjust(const SurfaceFeel& feel) noexcept;
  /// Notifies effects that follow the contact point. @param at in the object's axes [m]
  /// @param slid it slides  @param depth of the device below the SCP [m]  @param dt [s] of the step
  void follow(const Eigen::Vector3d& at, bool slid, const ObjectContact& contact, double depth,
              double dt) noexcept;
  /// Computes the forces of its springs into `contact`, whose point and normal are known.
  /// @param scp, device in the object's axes [m]
  void hold(const PlannedObject& object, const Eigen::Vector3d& scp, const Eigen::Vector3d& device,
            ObjectContact& contact) noexcept;
  /// Adds the forces of the other effects [N, S] to `total`. @param gain share of the springs that
  /// the device shows, [0, 1]
  void add_forces(const PlannedObject& object, const ObjectContact& contact, EffectContact& seen,
                  double gain, Eigen::Vector3d& total) noexcept;
};

}  // namespace reckon::haptics
