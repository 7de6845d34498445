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
[[nodiscard]] bool sweep_triangle(const Triangle& triangle, const Sweep& sweep, double limit,
                                  TriangleHit& hit) noexcept;

/// The same for a single point, `corner` [m]; `hit` stays unchanged without a contact.
[[nodiscard]] bool sweep_corner(const Eigen::Vector3d& corner, const Sweep& sweep, double limit,
                                TriangleHit& hit) noexcept;

/// The point of the triangle nearest to p.
[[nodiscard]] Eigen::Vector3d closest_on_triangle(const Triangle& triangle,
                                                  const Eigen::Vector3d& p) noexcept;

/// Whether the foot of p on the triangle's plane is in the triangle, border included.
[[nodiscard]] inline bool is_over(const Triangle& t, const Eigen::Vector3d& p) noexcept {
  return t.normal.dot((t.b - t.a).cross(p - t.a)) >= 0.0 &&
         t.normal.dot((t.c - t.b).cross(p - t.b)) >= 0.0 &&
         t.normal.dot((t.a - t.c).cross(p - t.c)) >= 0.0;
}

/// Whether the ray p + s direction, s > 0, crosses the triangle.
[[nodiscard]] bool ray_crosses(const Triangle& triangle, const Eigen::Vector3d& p,
                               const Eigen::Vector3d& direction) noexcept;

}  // namespace reckon::haptics
