// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/queries/box_axes.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

namespace reckon::haptics {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kLeastSine = 1e-14;  // sine between edges; below it the direction is noise
constexpr double kBetter =
    1e-13;  // of the sizes, so that rounding does not prefer an edge to a face

}  // namespace

AxisGap widest_gap(const OrientedBox& a, const OrientedBox& b) noexcept {
  const Vector3d between = b.centre - a.centre;
  const Matrix3d turn = a.axes.transpose() * b.axes;
  const Matrix3d slant = turn.cwiseAbs();
  const Vector3d between_a = a.axes.transpose() * between;
  const Vector3d between_b = b.axes.transpose() * between;
  AxisGap best{-std::numeric_limits<double>::infinity(), Vector3d::UnitX()};
  const auto offer = [&](double along, double reach, const Vector3d& axis, double margin) {
    const double gap = std::abs(along) - reach;
    if (gap > best.gap + margin) best = {gap, along < 0.0 ? Vector3d(-axis) : axis};
  };
  for (Eigen::Index i = 0; i < 3; ++i)
    offer(between_a[i], a.half[i] + slant.row(i).dot(b.half), a.axes.col(i), 0.0);
  for (Eigen::Index j = 0; j < 3; ++j)
    offer(between_b[j], b.half[j] + slant.col(j).dot(a.half), b.axes.col(j), 0.0);
  const double margin = kBetter * (a.half.sum() + b.half.sum());
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index j = 0; j < 3; ++j) {
      const Vector3d across = a.axes.col(i).cross(b.axes.col(j));
      const double sine = across.norm();
      if (sine < kLeastSine) continue;
      // Any unit vector gives a true bound, so that near-parallel edges need no tolerance.
      const Vector3d axis = across / sine;
      const double reach = (a.axes.transpose() * axis).cwiseAbs().dot(a.half) +
                           (b.axes.transpose() * axis).cwiseAbs().dot(b.half);
      offer(axis.dot(between), reach, axis, margin);
    }
  }
  return best;
}

}  // namespace reckon::haptics
