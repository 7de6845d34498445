// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// All objects of a plan as the obstacles of a ContactWalk.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>

#include "reckon/haptics/geometry/contact_walk.hpp"
#include "reckon/haptics/geometry/friction_cone.hpp"
#include "reckon/haptics/scene/effect_plan.hpp"

namespace reckon::haptics {

/// A probe of `radius` [m] among the objects. p is relative to `anchor` [m, S], so that planes and
/// levels stay small at any distance of the objects from the origin.
struct ObjectObstacles {
  std::span<const PlannedObject* const> objects;  ///< objects of the plan at their present poses
  std::span<FrictionCone* const> cones;           ///< per object; null if it is smooth
  std::span<const std::uint32_t> within_reach;    ///< objects that the walk may meet
  double radius;
  Eigen::Vector3d anchor;

  [[nodiscard]] bool sweep(const Eigen::Vector3d& p, const Eigen::Vector3d& step,
                           SweepHit& hit) const noexcept;
  [[nodiscard]] bool within(const Eigen::Vector3d& p) const noexcept;
  /// Smallest clearance of the objects within reach.
  [[nodiscard]] double clearance() const noexcept;
  [[nodiscard]] double size() const noexcept { return radius; }
  [[nodiscard]] bool holds(const ConstraintPlane& /*plane*/,
                           const Eigen::Vector3d& /*p*/) const noexcept {
    return false;
  }
  /// Each object that carries load holds with its own friction coefficient.
  [[nodiscard]] double held(double lateral, const ConstraintPlanes& planes,
                            const ConstraintSolution& solution, bool sliding) const noexcept;
};

}  // namespace reckon::haptics
