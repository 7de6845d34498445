// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Exact queries against one triangle, free of any absolute length: a swept point against the
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

/// Way of a point and how near it may come.
struct Sweep {
  Eigen::Vector3d origin;  ///< [m]
  Eigen::Vector3d step;    ///< [m]
  double radius;           ///< [m], > 0
  double floor;            ///< [m], below the radius: nearer than this nothing is let pass
  /// Inward way [m] that is let pass for a point that starts between floor and radius, so that
  /// sliding along a surface is not stopped by rounding.
  double slack;
};

/// First contact of a sweep with one triangle.
struct TriangleHit {
  double t;                ///< share of the step, [0, 1]
  Eigen::Vector3d normal;  ///< unit, from the triangle to the point
  bool on_face;            ///< flat of the triangle; else round an edge or a corner
};

/// First time, before `limit`, at which the swept point comes within the radius of the triangle.
/// One that starts within it is stopped (t = 0) only where the step leads nearer.
[[nodiscard]] bool sweep_triangle(const Triangle& triangle, const Sweep& sweep, double limit,
                                  TriangleHit& hit) noexcept;

/// The same for a single point, `corner` [m]; nothing is done to `hit` unless it is met.
[[nodiscard]] bool sweep_corner(const Eigen::Vector3d& corner, const Sweep& sweep, double limit,
                                TriangleHit& hit) noexcept;

/// Point of the triangle that is nearest to p.
[[nodiscard]] Eigen::Vector3d closest_on_triangle(const Triangle& triangle,
                                                  const Eigen::Vector3d& p) noexcept;

/// True where the foot of p on the triangle's plane lies in the triangle, border included.
[[nodiscard]] inline bool is_over(const Triangle& t, const Eigen::Vector3d& p) noexcept {
  return t.normal.dot((t.b - t.a).cross(p - t.a)) >= 0.0 &&
         t.normal.dot((t.c - t.b).cross(p - t.b)) >= 0.0 &&
         t.normal.dot((t.a - t.c).cross(p - t.c)) >= 0.0;
}

/// True where the ray p + s direction, s > 0, crosses the triangle.
[[nodiscard]] bool ray_crosses(const Triangle& triangle, const Eigen::Vector3d& p,
                               const Eigen::Vector3d& direction) noexcept;

}  // namespace reckon::haptics
