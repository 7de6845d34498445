// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A solid given by a signed function f, for a surface contact point (SCP). A sweep misses nothing,
// because f never exceeds the distance.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <string>

#include "reckon/haptics/geometry/shape.hpp"
#include "reckon/haptics/geometry/sweep_hit.hpp"
#include "reckon/haptics/implicit/signed_function.hpp"

namespace reckon::haptics {

/// Solid where f < 0, object axes [m]. A probe of radius r touches where f = r. Where f is the
/// distance, its ball then touches the surface. At convex edges of intersections and differences f
/// is less, and the ball stays up to the mitre away.
///
/// The SCP settles at one clearance above that: 0.4 nm, or 1e-10 of the size for objects above 4 m.
class ImplicitSolid {
 public:
  /// @param what name for the print of a plan, "cylinder"
  /// @throws std::invalid_argument for a function without a solid part
  ImplicitSolid(SignedFunction function, std::string what);
  /// @throws std::invalid_argument for dimensions without a solid
  explicit ImplicitSolid(const CylinderShape& shape);
  explicit ImplicitSolid(const ConeShape& shape);
  explicit ImplicitSolid(const TorusShape& shape);
  explicit ImplicitSolid(const EllipsoidShape& shape);
  explicit ImplicitSolid(const CsgShape& shape);

  /// f at p, and its gradient, which is the normal of the surface where |f| is small. About 5 to 40
  /// ns a primitive.
  [[nodiscard]] SignedSample sample(const Eigen::Vector3d& p) const noexcept;
  /// Whether a probe at p overlaps the solid.
  [[nodiscard]] bool contains(const Eigen::Vector3d& p, double radius = 0.0) const noexcept;
  /// A point near p at which an SCP may rest; p is inside.
  [[nodiscard]] Eigen::Vector3d nearest_outside(const Eigen::Vector3d& p,
                                                double radius = 0.0) const noexcept;
  /// First time at which a probe that moves from `origin` by `step` meets the surface. A probe that
  /// overlaps it already is stopped only if it would come closer. The sweep may stop early at a
  /// surface that runs along the path (SweepHit::curved). At most kMostSamples evaluations of f.
  /// @return false for a free path
  [[nodiscard]] bool sweep(const Eigen::Vector3d& origin, const Eigen::Vector3d& step,
                           double radius, SweepHit& hit) const noexcept;
  /// Lower bound of the distance of p from the solid [m]; 0 or below inside it.
  [[nodiscard]] double distance_below(const Eigen::Vector3d& p) const noexcept;
  [[nodiscard]] double clearance() const noexcept { return clearance_; }
  /// Infinite if the solid may be unbounded.
  [[nodiscard]] const Eigen::AlignedBox3d& bounds() const noexcept { return cut_; }
  /// Diagonal of the bounds [m]; 1 if they are infinite.
  [[nodiscard]] double size() const noexcept { return size_; }
  [[nodiscard]] const SignedFunction& function() const noexcept { return function_; }
  /// "torus", "solid of 5 parts".
  [[nodiscard]] const std::string& what() const noexcept { return what_; }
  /// Its dimensions, if it is a cylinder.
  [[nodiscard]] const std::optional<CylinderShape>& cylinder() const noexcept { return cylinder_; }

  /// Most evaluations of f in one sweep.
  static constexpr int kMostSamples = 64;

 private:
  [[nodiscard]] WaySample sample_along(const Eigen::Vector3d& p, const Eigen::Vector3d& direction,
                                       double level) const noexcept;
  [[nodiscard]] SweepHit hit_at(double t, const Eigen::Vector3d& gradient,
                                const Eigen::Vector3d& direction) const noexcept;
  [[nodiscard]] bool climb_out(Eigen::Vector3d& p, double radius) const noexcept;

  SignedFunction function_;
  std::string what_;
  std::optional<CylinderShape> cylinder_;
  double size_ = 1.0;
  double clearance_ = 0.0;
  Eigen::AlignedBox3d cut_;  // contains the solid, and its mitres except for the radius
};

}  // namespace reckon::haptics
