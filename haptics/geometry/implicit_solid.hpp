// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A solid that is a signed function f, as a surface contact point (SCP) meets it: swept without a
// gap, since f is never more than the distance.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>

#include "reckon/haptics/geometry/shape.hpp"
#include "reckon/haptics/geometry/sweep_hit.hpp"
#include "reckon/haptics/implicit/signed_function.hpp"

namespace reckon::haptics {

/// Solid where f < 0, object axes [m]. A probe of radius r touches where f = r: its ball lies on
/// the surface where f is the distance, and stays up to the mitre away from it at the convex edges
/// of intersections and differences, where f is less.
///
/// The SCP settles at one clearance above that: 0.4 nm, of objects above 4 m 1e-10 of their size.
class ImplicitSolid {
 public:
  /// @param what it is called where a plan is printed, "cylinder"
  /// @throws std::invalid_argument for a function that leaves nothing solid
  ImplicitSolid(SignedFunction function, std::string what);
  /// @throws std::invalid_argument for measures that make no solid
  explicit ImplicitSolid(const CylinderShape& shape);
  explicit ImplicitSolid(const ConeShape& shape);
  explicit ImplicitSolid(const TorusShape& shape);
  explicit ImplicitSolid(const EllipsoidShape& shape);
  explicit ImplicitSolid(const CsgShape& shape);

  /// f at p, and its gradient; the normal of the surface where |f| is small. About 5 to 40 ns a
  /// primitive.
  [[nodiscard]] SignedSample sample(const Eigen::Vector3d& p) const noexcept;
  /// True where a probe at p overlaps the solid.
  [[nodiscard]] bool contains(const Eigen::Vector3d& p, double radius = 0.0) const noexcept;
  /// A point near p, which is inside, at which an SCP may rest.
  [[nodiscard]] Eigen::Vector3d nearest_outside(const Eigen::Vector3d& p,
                                                double radius = 0.0) const noexcept;
  /// First time at which a probe that goes from `origin` by `step` meets the surface; one that
  /// overlaps it already is stopped only where it would come closer. It may stop short of a surface
  /// that it runs along (SweepHit::curved). At most kMostSamples evaluations of f.
  /// @return false for a free way
  [[nodiscard]] bool sweep(const Eigen::Vector3d& origin, const Eigen::Vector3d& step,
                           double radius, SweepHit& hit) const noexcept;
  /// At most the distance of p from the solid [m]; 0 or below within it.
  [[nodiscard]] double distance_below(const Eigen::Vector3d& p) const noexcept;
  [[nodiscard]] double clearance() const noexcept { return clearance_; }
  /// Infinite where the solid may have no end.
  [[nodiscard]] const Eigen::AlignedBox3d& bounds() const noexcept { return cut_; }
  /// Diagonal of the bounds [m]; 1 where they are infinite.
  [[nodiscard]] double size() const noexcept { return size_; }
  [[nodiscard]] const SignedFunction& function() const noexcept { return function_; }
  /// "torus", "solid of 5 parts".
  [[nodiscard]] const std::string& what() const noexcept { return what_; }

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
  double size_ = 1.0;
  double clearance_ = 0.0;
  Eigen::AlignedBox3d cut_;  // the solid is within it, and so are the mitres, but for the radius
};

}  // namespace reckon::haptics
