// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Contact of one device point with all objects of a plan: one surface contact point (SCP) per
// object, objects far away left out by a tree of their boxes, forces summed. Runs inside the servo
// step.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "reckon/haptics/geometry/surface_contact_point.hpp"
#include "reckon/haptics/scene/effect_plan.hpp"

namespace reckon::haptics {

/// Contact with one object, frame S.
struct ObjectContact {
  /// [m]; of one that is free, the device point when it was last near.
  Eigen::Vector3d scp = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit, out of the solid; zero when free
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< of its springs on the device [N]
  double stored_energy = 0.0;                        ///< 1/2 k |device - scp|^2 [J]
  double depth = 0.0;                                ///< |device - scp| [m]
  bool in_contact = false;
  bool started_inside = false;  ///< since reset, until this object is left once
};

/// Outcome of a step, frame S. The spans stay valid until the solver's next call.
struct ContactResult {
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  Eigen::Vector3d scp = Eigen::Vector3d::Zero();     ///< of the deepest contact; device when free
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< there, unit; zero when free
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< springs only, summed over objects [N]
  double stored_energy = 0.0;                        ///< summed over objects [J]
  std::size_t deepest = kNone;                       ///< index of the deepest contact in objects
  bool in_contact = false;
  bool started_inside = false;             ///< of any object: the servo ramps the force up
  std::span<const ObjectContact> objects;  ///< in the plan's order
  std::span<const std::uint32_t> touched;  ///< indices of those in contact, ascending
};

/// Each object has its own SCP and knows nothing of the others: where two objects overlap, the SCP
/// of one may lie inside the other. For a device point that holds still no step raises |device -
/// scp| of any object, so that the stored energy can only fall when the SCP moves: storage of a
/// passive virtual wall.
class ContactSolver {
 public:
  /// @param plan outlives the solver; shared between solvers it is only read.
  explicit ContactSolver(const EffectPlan& plan);
  ContactSolver(const ContactSolver&) = delete;
  ContactSolver& operator=(const ContactSolver&) = delete;

  /// Starts anew at `device` [m, S]: where that lies inside an object, its SCP is put on the
  /// nearest outside point of the surface and started_inside is set. No allocation; looks at every
  /// object, tens of nanoseconds each, tens of microseconds for a mesh.
  ContactResult reset(const Eigen::Vector3d& device) noexcept;

  /// Moves every SCP to where it settles for this device position [m, S]; any position is allowed,
  /// one that is not finite or beyond 1e9 m gives no force, the last scp, and changes nothing. The
  /// first call resets. No allocation. Looks at the objects touched before and at those near the
  /// way from the last position: logarithmic in all others.
  ContactResult step(const Eigen::Vector3d& device) noexcept;

  /// What the effects give beside the springs [N, S], summed over objects, at the last step's
  /// contacts: dampers, and whatever else has the hook force(). Once a step, so that an effect may
  /// keep time. Not bounded, nor finite: StaticContact sees to it. No allocation.
  /// @param velocity of the device [m/s, S]  @param dt [s], how long the force will be held
  [[nodiscard]] Eigen::Vector3d effect_force(const Eigen::Vector3d& velocity, double dt) noexcept;

  /// Evaluations of friction since the last reset; zero for a scene that declares none.
  [[nodiscard]] std::uint64_t friction_calls() noexcept;

 private:
  struct ObjectState {
    SurfaceContactPoint point;
    PlannedEffects effects;
  };

  [[nodiscard]] bool far_from(const PlannedObject& object,
                              const Eigen::Vector3d& device) const noexcept;
  void find_near(const Eigen::Vector3d& device) noexcept;
  void update_object(std::size_t index, const Eigen::Vector3d& device) noexcept;
  void settle(std::size_t index, const Eigen::Vector3d& device) noexcept;
  [[nodiscard]] ContactResult nothing() const noexcept;
  [[nodiscard]] ContactResult sum(const Eigen::Vector3d& device) noexcept;

  const EffectPlan& plan_;
  std::vector<ObjectState> states_;
  std::vector<ObjectContact> contacts_;
  std::vector<std::uint32_t> near_;     // objects of this step, ascending
  std::vector<std::uint32_t> touched_;  // of these, the ones in contact
  std::vector<std::uint64_t> noted_;    // per object, the step in which it was put into near_
  std::uint64_t step_ = 0;
  Eigen::Vector3d last_device_ = Eigen::Vector3d::Zero();  // S, of the last finite step
  bool started_ = false;
};

}  // namespace reckon::haptics
