// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Volume, center of mass and inertia of the solid in a closed mesh.
#pragma once

#include <Eigen/Core>

#include "reckon/haptics/geometry/surface_mesh.hpp"

namespace reckon::haptics {

/// For uniform density, in the axes of the mesh.
struct SolidMoments {
  double volume = 0.0;                               ///< [m^3]
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  ///< [m], center of mass
  Eigen::Matrix3d inertia =
      Eigen::Matrix3d::Zero();  ///< about the center of mass, for a mass of 1 kg [m^2]
};

/// Exact for the mesh: a sum over the tetrahedra between its triangles and a point near it.
/// O(triangles). For an open mesh the result is meaningless.
[[nodiscard]] SolidMoments moments_of(const SurfaceMesh& mesh);

}  // namespace reckon::haptics
