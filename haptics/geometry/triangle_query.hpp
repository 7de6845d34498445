// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Exact queries against one triangle, without any absolute length: a swept point against the
// triangle rounded by a radius, the nearest point, and a ray crossing.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace reckon::haptics {

/// A triangle with its unit normal; object axes [m].
struct Triangle {
  Eigen::Vector3d a, b, c;
  Eigen::Vector3d normal;  ///< along (b - a) x (c - a)
};

/// Refers to a triangle, whose parts may be apart in memory. For a call, not to be kept.
struct TriangleView {
  const Eigen::Vector3d &a, &b, &c, &normal;

  TriangleView(const Eigen::Vector3d& first, const Eigen::Vector3d& second,
               const Eigen::Vector3d& third, const Eigen::Vector3d& up) noexcept
      : a(first), b(second), c(third), normal(up) {}
  TriangleView(const Triangle& t) noexcept : TriangleView(t.a, t.b, t.c, t.normal) {}
};

/// Path of a point, and the distances at which it stops.
struct Sweep {
  Eigen::Vector3d origin;  ///< [m]
  Eigen::Vector3d step;    ///< [m]
  double radius;           ///< [m], > 0
  double floor;            ///< [m], below the radius: no nearer point may pass
  /// Inward motion [m] allowed for a point that starts between floor and radius, so that rounding
  /// does not stop a slide along a surface.
  double slack;
};

/// First contact of a sweep with one triangle.
struct TriangleHit {
  double t;                ///< share of the step, [0, 1]
  Eigen::Vector3d normal;  ///< unit, from the triangle to the point
  bool on_face;            ///< flat of the triangle; else round an edge or a corner
};

/// First time, before `limit`, at which the swept point comes within the radius of the triangle. A
/// point that starts within it is stopped (t = 0) only if the step leads nearer.
[[nodiscard]] bool sweep_triangle(const TriangleView& triangle, const Sweep& sweep, double limit,
                                  TriangleHit& hit) noexcept;

/// The same for a single point, `corner` [m]; `hit` stays unchanged without a contact.
[[nodiscard]] bool sweep_corner(const Eigen::Vector3d& corner, const Sweep& sweep, double limit,
                                TriangleHit& hit) noexcept;

/// The point of the triangle a, b, c nearest to p.
[[nodiscard]] Eigen::Vector3d closest_on_triangle(const Eigen::Vector3d& a,
                                                  const Eigen::Vector3d& b,
                                                  const Eigen::Vector3d& c,
                                                  const Eigen::Vector3d& p) noexcept;
[[nodiscard]] inline Eigen::Vector3d closest_on_triangle(const TriangleView& triangle,
                                                         const Eigen::Vector3d& p) noexcept {
  return closest_on_triangle(triangle.a, triangle.b, triangle.c, p);
}

/// Whether the foot of p on the triangle's plane is in the triangle, border included.
[[nodiscard]] inline bool is_over(const TriangleView& t, const Eigen::Vector3d& p) noexcept {
  return t.normal.dot((t.b - t.a).cross(p - t.a)) >= 0.0 &&
         t.normal.dot((t.c - t.b).cross(p - t.b)) >= 0.0 &&
         t.normal.dot((t.a - t.c).cross(p - t.c)) >= 0.0;
}

/// Whether the ray p + s direction, s > 0, crosses the triangle.
[[nodiscard]] bool ray_crosses(const TriangleView& triangle, const Eigen::Vector3d& p,
                               const Eigen::Vector3d& direction) noexcept;

}  // namespace reckon::haptics
