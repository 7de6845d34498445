// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/geometry/solid_moments.hpp"

namespace reckon::haptics {

using Eigen::Matrix3d;
using Eigen::Vector3d;

SolidMoments moments_of(const SurfaceMesh& mesh) {
  const Vector3d from = mesh.bounds().center();
  double volume = 0.0;
  Vector3d first = Vector3d::Zero();
  Matrix3d second = Matrix3d::Zero();  // integral of p p^T
  for (const Triangle& triangle : mesh.triangles()) {
    const Vector3d a = triangle.a - from, b = triangle.b - from, c = triangle.c - from;
    const double six = a.dot(b.cross(c));
    const Vector3d sum = a + b + c;
    volume += six / 6.0;
    first += six / 24.0 * sum;
    second += six / 120.0 *
              (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
  SolidMoments out;
  out.volume = volume;
  if (!(volume > 0)) return out;
  const Vector3d middle = first / volume;
  const Matrix3d spread = second / volume - middle * middle.transpose();
  out.middle = from + middle;
  out.inertia = spread.trace() * Matrix3d::Identity() - spread;
  return out;
}

}  // namespace reckon::haptics
