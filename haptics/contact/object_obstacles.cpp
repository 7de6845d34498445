// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/contact/object_obstacles.hpp"

#include <algorithm>
#include <limits>

#include "reckon/haptics/geometry/surface_contact_point.hpp"

namespace reckon::haptics {

using Eigen::Vector3d;

bool ObjectObstacles::sweep(const Vector3d& p, const Vector3d& step, SweepHit& hit) const noexcept {
  const Vector3d from = anchor + p;
  const Vector3d to = from + step;
  const Eigen::AlignedBox3d way(from.cwiseMin(to).array() - radius,
                                from.cwiseMax(to).array() + radius);
  bool found = false;
  for (const std::uint32_t index : within_reach) {
    const PlannedObject& object = *objects[index];
    if (!object.bounds.intersects(way)) continue;
    const Vector3d origin = object.orientation.transpose() * ((anchor - object.position) + p);
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

bool ObjectObstacles::within(const Vector3d& p) const noexcept {
  return std::any_of(within_reach.begin(), within_reach.end(), [&](std::uint32_t index) {
    const PlannedObject& object = *objects[index];
    const Vector3d local = object.orientation.transpose() * ((anchor - object.position) + p);
    return is_within(object.shape, local, radius);
  });
}

double ObjectObstacles::clearance() const noexcept {
  double least = std::numeric_limits<double>::infinity();
  for (const std::uint32_t index : within_reach) {
    least = std::min(least, clearance_of(objects[index]->shape));
  }
  return least;
}

double ObjectObstacles::held(double lateral, const ConstraintPlanes& planes,
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

}  // namespace reckon::haptics
