// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How a body resists being moved and turned, by its shape.
#pragma once

#include <Eigen/Core>

#include "reckon/haptics/bodies/ode_calls.hpp"
#include "reckon/haptics/scene/effect_plan.hpp"

namespace reckon::haptics {

/// Of one density. Axes: those of its shape.
struct BodyMass {
  dMass mass;                                        ///< about its middle
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  ///< of mass [m]
  double inner = 0.0;                                ///< [m], radius of the ball about it within
  double least_inertia = 0.0;                        ///< [kg m^2], of its principal ones
};

/// @param object a ball, a box, or with a mesh; it has a mass  @param mesh closed, or null
[[nodiscard]] BodyMass mass_of(const PlannedObject& object, const SurfaceMesh* mesh);

}  // namespace reckon::haptics
