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
[[nodiscard]] inline SolidMoments moments_of(const SurfaceMesh& mesh) {
  const Eigen::Vector3d from = mesh.bounds().center();
  double volume = 0.0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();  // integral of p p^T
  for (const Triangle& triangle : mesh.triangles()) {
    const Eigen::Vector3d a = triangle.a - from, b = triangle.b - from, c = triangle.c - from;
    const double six = a.dot(b.cross(c));
    const Eigen::Vector3d sum = a + b + c;
    volume += six / 6.0;
    first += six / 24.0 * sum;
    second += six / 120.0 *
              (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
  SolidMoments out;
  out.volume = volume;
  if (!(volume > 0)) return out;
  const Eigen::Vector3d middle = first / volume;
  const Eigen::Matrix3d spread = second / volume - middle * middle.transpose();
  out.middle = from + middle;
  out.inertia = spread.trace() * Eigen::Matrix3d::Identity() - spread;
  return out;
}

}  // namespace reckon::haptics
