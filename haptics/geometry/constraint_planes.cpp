// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/geometry/constraint_planes.hpp"

#include <Eigen/Geometry>

namespace reckon::haptics {

namespace {

using Eigen::Vector3d;

// Loads of `n` active planes: G load = shortfall, G the Gram matrix of their normals.
bool solve_loads(const std::array<const ConstraintPlane*, 3>& planes, std::size_t n,
                 const Vector3d& shortfall, Vector3d& load) {
  if (n == 0) return true;
  const Vector3d& n0 = planes[0]->normal;
  if (n == 1) {
    load[0] = shortfall[0];
    return true;
  }
  const Vector3d& n1 = planes[1]->normal;
  if (n == 2) {
    // |n0 - n1|^2 |n0 + n1|^2 / 4 = 1 - (n0.n1)^2 without its cancellation.
    const double determinant = 0.25 * (n0 - n1).squaredNorm() * (n0 + n1).squaredNorm();
    if (!(determinant > 1e-18)) return false;
    const double g = n0.dot(n1);
    load[0] = (shortfall[0] - g * shortfall[1]) / determinant;
    load[1] = (shortfall[1] - g * shortfall[0]) / determinant;
    return true;
  }
  // Three normals span space: N^T push = shortfall, N load = push.
  const Vector3d& n2 = planes[2]->normal;
  const Vector3d c12 = n1.cross(n2);
  const double determinant = n0.dot(c12);
  if (!(determinant * determinant > 1e-18)) return false;
  const Vector3d c20 = n2.cross(n0);
  const Vector3d c01 = n0.cross(n1);
  const Vector3d push =
      (shortfall[0] * c12 + shortfall[1] * c20 + shortfall[2] * c01) / determinant;
  load = Vector3d(c12.dot(push), c20.dot(push), c01.dot(push)) / determinant;
  return true;
}

}  // namespace

void ConstraintPlanes::add(const ConstraintPlane& plane, const Vector3d& at) noexcept {
  if (count_ < kMax) {
    planes_[count_++] = plane;
    return;
  }
  std::size_t farthest = 0;
  double most = -1.0;
  for (std::size_t i = 0; i < kMax; ++i) {
    const double slack = planes_[i].normal.dot(at) - planes_[i].level;
    if (slack <= most) continue;
    most = slack;
    farthest = i;
  }
  planes_[farthest] = plane;
}

bool ConstraintPlanes::try_active(const Vector3d& device, double tolerance,
                                  ConstraintSolution& out) const noexcept {
  std::array<const ConstraintPlane*, 3> active{};
  Vector3d shortfall = Vector3d::Zero();
  for (std::size_t i = 0; i < out.active_count; ++i) {
    active[i] = &planes_[out.active[i]];
    shortfall[static_cast<Eigen::Index>(i)] = active[i]->level - active[i]->normal.dot(device);
  }
  Vector3d load = Vector3d::Zero();
  if (!solve_loads(active, out.active_count, shortfall, load)) return false;
  out.push.setZero();
  out.load = 0.0;
  for (std::size_t i = 0; i < out.active_count; ++i) {
    const double one = load[static_cast<Eigen::Index>(i)];
    if (!(one >= 0.0)) return false;
    out.push += one * active[i]->normal;
    out.load += one;
    out.loads[i] = one;
  }
  out.point = device + out.push;
  for (std::size_t i = 0; i < count_; ++i) {
    if (!(planes_[i].normal.dot(out.point) >= planes_[i].level - tolerance)) return false;
  }
  return true;
}

bool ConstraintPlanes::solve(const Vector3d& device, double tolerance,
                             ConstraintSolution& out) const noexcept {
  out.active_count = 0;
  if (try_active(device, 0.0, out)) return true;
  out.active_count = 1;
  for (out.active[0] = 0; out.active[0] < count_; ++out.active[0]) {
    if (try_active(device, tolerance, out)) return true;
  }
  out.active_count = 2;
  for (out.active[0] = 0; out.active[0] < count_; ++out.active[0]) {
    for (out.active[1] = out.active[0] + 1; out.active[1] < count_; ++out.active[1]) {
      if (try_active(device, tolerance, out)) return true;
    }
  }
  out.active_count = 3;
  for (out.active[0] = 0; out.active[0] < count_; ++out.active[0]) {
    for (out.active[1] = out.active[0] + 1; out.active[1] < count_; ++out.active[1]) {
      for (out.active[2] = out.active[1] + 1; out.active[2] < count_; ++out.active[2]) {
        if (try_active(device, tolerance, out)) return true;
      }
    }
  }
  return false;
}

}  // namespace reckon::haptics
