// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Work of a moving surface on a probe.
#pragma once

#include <Eigen/Core>
#include <algorithm>

#include "reckon/haptics/passivity/contact_spring.hpp"

namespace reckon::haptics {

/// Force of a surface and its point of action.
struct SurfacePush {
  explicit SurfacePush(const ContactSpring& spring) noexcept
      : depth(std::max(0.0, spring.geometry().depth)),
        along(spring.normal_force()),
        across(spring.force() - along * spring.geometry().normal),
        point(spring.parameters().point) {}
  double depth;            ///< [m]
  double along;            ///< [N], along the normal
  Eigen::Vector3d across;  ///< [N], across the normal
  Eigen::Vector3d point;   ///< [m]
};

/// Work of the surface on the probe while it moved [J]. The normal part follows the change of
/// depth, the lateral part the motion of the surface. A change of stiffness does not count as work.
[[nodiscard]] inline double work_between(const SurfacePush& before,
                                         const SurfacePush& after) noexcept {
  return 0.5 * ((before.along + after.along) * (after.depth - before.depth) +
                (before.across + after.across).dot(after.point - before.point));
}

/// Whether a moving ball presses a probe more deeply during its motion than at either end.
[[nodiscard]] inline bool passes(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                 double reach, const Eigen::Vector3d& probe) noexcept {
  const Eigen::Vector3d way = to - from, away = probe - from;
  const double along = way.dot(away), length = way.squaredNorm();
  if (!(along > 0 && along < length)) return false;
  return (away - along / length * way).squaredNorm() < reach * reach;
}

}  // namespace reckon::haptics
