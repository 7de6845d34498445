// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Shapes for queries. Box, ball and capsule are one form: a box, possibly with zero extents, with a
// ball swept over it.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>
#include <variant>

#include "reckon/haptics/geometry/implicit_solid.hpp"
#include "reckon/haptics/geometry/shapes.hpp"
#include "reckon/haptics/geometry/surface_mesh.hpp"

namespace reckon::haptics {

/// Pose of a shape: p_S = orientation * p_shape + position.
struct Placement {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();         ///< [m], S
  Eigen::Matrix3d orientation = Eigen::Matrix3d::Identity();  ///< shape -> S, a rotation

  [[nodiscard]] Eigen::Vector3d to_scene(const Eigen::Vector3d& p) const noexcept {
    return orientation * p + position;
  }
  [[nodiscard]] Eigen::Vector3d to_shape(const Eigen::Vector3d& p_S) const noexcept {
    return orientation.transpose() * (p_S - position);
  }
};

/// All points within `radius` of a box around the origin.
struct RoundedBox {
  Eigen::Vector3d half = Eigen::Vector3d::Zero();  ///< half edges of the core [m], each >= 0
  double radius = 0.0;                             ///< [m], >= 0
};

/// All points below the plane through the origin.
struct BelowPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit, out of the solid
};

/// A shape in its own axes. Copies share meshes and solids. Construction may allocate; then many
/// threads may read it.
///
/// Example: how far is a can of 3 cm by 10 cm from a table?
///   const auto can = QueryShape::capsule(0.03, 0.04);
///   const auto table = QueryShape::box({1.0, 0.6, 0.02});
///   measure_pair(can, can_at, table, table_at).distance.least;  // [m]
class QueryShape {
 public:
  using Form = std::variant<BelowPlane, RoundedBox, std::shared_ptr<const SurfaceMesh>,
                            std::shared_ptr<const ImplicitSolid>>;

  /// @param size whole edges [m], each >= 0: 0 makes a plate, a rod or a point
  /// @throws std::invalid_argument for a size that is negative or not finite; the same for the
  /// functions below
  [[nodiscard]] static QueryShape box(const Eigen::Vector3d& size);
  /// @param radius [m], >= 0
  [[nodiscard]] static QueryShape sphere(double radius);
  /// Along z. @param radius [m], >= 0 @param length between the centers of its ends [m], >= 0
  [[nodiscard]] static QueryShape capsule(double radius, double length);
  /// @param normal out of the solid, any length > 0
  [[nodiscard]] static QueryShape below_plane(const Eigen::Vector3d& normal);
  /// From a contact shape. A mesh is in its own axes, see SurfaceMesh::origin().
  explicit QueryShape(const ContactShape& shape);

  [[nodiscard]] const Form& form() const noexcept { return form_; }
  /// Whether the shape is convex.
  [[nodiscard]] bool is_convex() const noexcept { return form_.index() < 2; }
  /// Bounding box in its own axes [m]; infinite for a plane and an unbounded solid.
  [[nodiscard]] const Eigen::AlignedBox3d& bounds() const noexcept { return bounds_; }
  [[nodiscard]] bool is_bounded() const noexcept { return bounded_; }
  /// Greatest displacement of any point by a rotation of 1 rad [m]; for a rounded box only of the
  /// core, because a rotated ball does not change. Infinite if unbounded.
  [[nodiscard]] double turning_reach() const noexcept { return turning_reach_; }
  /// Bounding box at a placement [m, S].
  [[nodiscard]] Eigen::AlignedBox3d bounds_at(const Placement& at) const noexcept;

 private:
  explicit QueryShape(Form form);

  Form form_;
  Eigen::AlignedBox3d bounds_;
  double turning_reach_ = 0.0;
  bool bounded_ = true;
};

}  // namespace reckon::haptics
