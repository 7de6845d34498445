// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Volume, middle and inertia of what a closed mesh encloses.
#pragma once

#include <Eigen/Core>

#include "reckon/haptics/geometry/surface_mesh.hpp"

namespace reckon::haptics {

/// Of a body of one density, in the axes of its mesh.
struct SolidMoments {
  double volume = 0.0;                                ///< [m^3]
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();   ///< [m], centre of mass
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about it, for a mass of 1 kg [m^2]
};

/// Exact for the mesh: a sum over the tetrahedra between its triangles and a point near it.
/// O(triangles). Of an open mesh, whatever that sum is.
[[nodiscard]] SolidMoments moments_of(const SurfaceMesh& mesh);

}  // namespace reckon::haptics
