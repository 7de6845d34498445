// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Separating axes of two boxes: 15 axes, face normals and cross products of edges (S. Gottschalk).
#pragma once

#include <Eigen/Core>

namespace reckon::haptics {

/// A box anywhere; extents may be zero.
struct OrientedBox {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();       ///< [m]
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();     ///< a rotation; columns are the axes
  Eigen::Vector3d half = Eigen::Vector3d::Constant(0.0);  ///< half edges [m], each >= 0
};

/// The axis along which two boxes overlap least, or are farthest apart.
struct AxisGap {
  double gap = 0.0;                                      ///< [m]; < 0: the boxes overlap
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< unit, from a to b
};

/// A negative gap is minus the least translation that separates the boxes, exact. A positive one is
/// a lower bound of their distance. Of equal gaps the first axis is taken: x, y, z of a, x, y, z of
/// b, then cross products of edges, which must be better by 1e-13 of the sizes. If the centers
/// coincide along the axis, the direction is positive. 0.3 us.
[[nodiscard]] AxisGap widest_gap(const OrientedBox& a, const OrientedBox& b) noexcept;

}  // namespace reckon::haptics
