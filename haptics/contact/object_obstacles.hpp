// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// All objects of a plan as the obstacles of a ContactWalk.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>

#include "reckon/haptics/geometry/contact_walk.hpp"
#include "reckon/haptics/geometry/friction_cone.hpp"
#include "reckon/haptics/geometry/surface_contact_point.hpp"
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
                           SweepHit& hit) const noexcept {
    const Eigen::Vector3d from = anchor + p;
    const Eigen::Vector3d to = from + step;
    const Eigen::AlignedBox3d way(from.cwiseMin(to).array() - radius,
                                  from.cwiseMax(to).array() + radius);
    bool found = false;
    for (const std::uint32_t index : within_reach) {
      const PlannedObject& object = *objects[index];
      if (!object.bounds.intersects(way)) continue;
      const Eigen::Vector3d origin =
          object.orientation.transpose() * ((anchor - object.position) + p);
      SweepHit one;
      if (!sweep_shape(object.shape, origin, object.orientation.transpose() * step, radius, one))
        continue;
      if (found && one.t >= hit.t) continue;
      hit = one;
      hit.normal = object.orientation * one.normal;
      hit.object = index;
      found = true;
    }
    return found;
  }
  [[nodiscard]] bool within(const Eigen::Vector3d& p) const noexcept {
    return std::any_of(within_reach.begin(), within_reach.end(), [&](std::uint32_t index) {
      const PlannedObject& object = *objects[index];
      const Eigen::Vector3d local =
          object.orientation.transpose() * ((anchor - object.position) + p);
      return is_within(object.shape, local, radius);
    });
  }
  /// Smallest clearance of the objects within reach.
  [[nodiscard]] double clearance() const noexcept {
    double least = std::numeric_limits<double>::infinity();
    for (const std::uint32_t index : within_reach) {
      least = std::min(least, clearance_of(objects[index]->shape));
    }
    return least;
  }
  [[nodiscard]] double size() const noexcept { return radius; }
  [[nodiscard]] bool holds(const ConstraintPlane& /*plane*/,
                           const Eigen::Vector3d& /*p*/) const noexcept {
    return false;
  }
  /// Each object that carries load holds with its own friction coefficient.
  [[nodiscard]] double held(double lateral, const ConstraintPlanes& planes,
                            const ConstraintSolution& solution, bool sliding) const noexcept {
    double holds = 0.0;
    double kinetic = 0.0;
    for (std::size_t i = 0; i < solution.active_count; ++i) {
      FrictionCone* cone = cones[planes[solution.active[i]].object];
      if (cone == nullptr) continue;
      holds += cone->coefficient(sliding) * solution.loads[i];
      kinetic += cone->kinetic() * solution.loads[i];
    }
    return lateral <= holds ? lateral : kinetic;
  }
};

}  // namespace reckon::haptics
