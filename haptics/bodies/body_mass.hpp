// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Mass and inertia of a body from its shape.
#pragma once

#include <Eigen/Core>

#include "reckon/haptics/bodies/ode_calls.hpp"
#include "reckon/haptics/scene/effect_plan.hpp"

namespace reckon::haptics {

/// For uniform density, in the axes of the shape.
struct BodyMass {
  dMass mass;                                        ///< about its center of mass
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  ///< center of mass [m]
  double inner = 0.0;          ///< [m], radius of the largest ball around it inside the body
  double least_inertia = 0.0;  ///< [kg m^2], least principal moment of inertia
};

/// @param object a ball or box, or any shape with a mesh; it has a mass @param mesh closed, or null
[[nodiscard]] BodyMass mass_of(const PlannedObject& object, const SurfaceMesh* mesh);

}  // namespace reckon::haptics
