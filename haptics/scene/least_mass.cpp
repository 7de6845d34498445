// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/scene/least_mass.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>
#include <memory>
#include <stdexcept>
#include <variant>

#include "reckon/haptics/geometry/implicit_solid.hpp"
#include "reckon/haptics/geometry/solid_mesh.hpp"
#include "reckon/haptics/geometry/solid_moments.hpp"
#include "reckon/haptics/geometry/surface_mesh.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using MeshPointer = std::shared_ptr<const SurfaceMesh>;
using SolidPointer = std::shared_ptr<const ImplicitSolid>;

constexpr int kCells = 20;                 // along a solid, as in BodyGeoms
constexpr double kBallsShare = 1.0 / 3.5;  // 1 / (1 + m r^2 / (2/5 m r^2))
constexpr double kEndless = std::numeric_limits<double>::infinity();

// Rotational part of 1 / m_eff = 1/m + (r x t) . I^-1 (r x t), the greatest over all unit t.
double turning_at(const Vector3d& r, const Matrix3d& inverse) {
  Matrix3d cross;
  cross << 0.0, -r.z(), r.y(), r.z(), 0.0, -r.x(), -r.y(), r.x(), 0.0;
  const Matrix3d form = cross.transpose() * inverse * cross;
  return Eigen::SelfAdjointEigenSolver<Matrix3d>(form, Eigen::EigenvaluesOnly).eigenvalues()(2);
}

double share_of(const Block& block) {
  const Vector3d square = block.bounds().sizes().cwiseAbs2();
  const Vector3d inertia = (Vector3d::Constant(square.sum()) - square) / 12.0;
  const Matrix3d inverse = inertia.cwiseInverse().asDiagonal();
  return 1.0 / (1.0 + turning_at(0.5 * block.bounds().sizes(), inverse));
}

// Convex in the position, so the greatest value is at a corner.
double share_of(const SurfaceMesh& mesh) {
  const SolidMoments moments = moments_of(mesh);
  const Matrix3d inverse = moments.inertia.inverse();
  if (!inverse.allFinite()) return 0.0;
  double most = 0.0;
  for (const Triangle& triangle : mesh.triangles()) {
    for (const Vector3d& corner : {triangle.a, triangle.b, triangle.c})
      most = std::max(most, turning_at(corner - moments.middle, inverse));
  }
  return 1.0 / (1.0 + most);
}

}  // namespace

double least_mass_of(const PlannedObject& body) {
  const double mass = body.matter.mass;
  if (std::holds_alternative<Ball>(body.shape)) return kBallsShare * mass;
  if (const auto* block = std::get_if<Block>(&body.shape)) return share_of(*block) * mass;
  if (const auto* mesh = std::get_if<MeshPointer>(&body.shape)) return share_of(**mesh) * mass;
  const auto* solid = std::get_if<SolidPointer>(&body.shape);
  if (solid == nullptr || !(*solid)->bounds().sizes().allFinite()) return kEndless;
  try {
    return share_of(SurfaceMesh(mesh_of(**solid, kCells))) * mass;
  } catch (const std::invalid_argument&) {
    return kEndless;  // not a body: BodyGeoms refuses it with the remedy
  }
}

}  // namespace reckon::haptics
