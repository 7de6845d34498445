// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/bodies/body_mass.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <variant>

#include "reckon/haptics/bodies/body_geoms.hpp"
#include "reckon/haptics/geometry/solid_moments.hpp"
#include "reckon/haptics/geometry/surface_mesh.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

BodyMass of_mesh(const SurfaceMesh& mesh, double mass) {
  const SolidMoments moments = moments_of(mesh);
  const Matrix3d inertia = mass * moments.inertia;
  BodyMass out;
  dMassSetParameters(&out.mass, mass, 0, 0, 0, inertia(0, 0), inertia(1, 1), inertia(2, 2),
                     inertia(0, 1), inertia(0, 2), inertia(1, 2));
  out.middle = moments.middle;
  const Eigen::SelfAdjointEigenSolver<Matrix3d> principal(inertia, Eigen::EigenvaluesOnly);
  out.least_inertia = principal.eigenvalues()(0);
  ClosestPoint nearest;
  static_cast<void>(mesh.closest_from(moments.middle, 0, nearest));
  if (mesh.contains(moments.middle)) out.inner = nearest.distance;
  return out;
}

}  // namespace

BodyMass mass_of(const PlannedObject& object, const SurfaceMesh* mesh) {
  const double mass = object.matter.mass;
  BodyMass out;
  if (const CylinderShape* cylinder = cylinder_of(object); cylinder != nullptr) {
    constexpr int kAlongZ = 3;
    out.inner = std::min(cylinder->radius, 0.5 * cylinder->height);
    dMassSetCylinderTotal(&out.mass, mass, kAlongZ, cylinder->radius, cylinder->height);
  } else if (mesh != nullptr) {
    return of_mesh(*mesh, mass);
  } else if (const auto* ball = std::get_if<Ball>(&object.shape)) {
    out.inner = 0.5 * ball->bounds().sizes().x();
    dMassSetSphereTotal(&out.mass, mass, out.inner);
  } else {
    const Vector3d size = std::get<Block>(object.shape).bounds().sizes();
    out.inner = 0.5 * size.minCoeff();
    dMassSetBoxTotal(&out.mass, mass, size.x(), size.y(), size.z());
  }
  out.least_inertia = std::min({out.mass.I[0], out.mass.I[5], out.mass.I[10]});
  return out;
}

}  // namespace reckon::haptics
