// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/geometry/triangle_query.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace reckon::haptics {

namespace {

using Eigen::Vector3d;

/// Motion relative to the axis of a rounded edge or to a corner, across that axis.
struct Approach {
  Vector3d offset;  // from the axis or corner to the origin of the sweep
  Vector3d way;
};

// First time at which |offset + t way| falls to the radius. Sweep::slack describes a start within
// it.
bool enters(const Approach& approach, const Sweep& sweep, double limit, double& t,
            Vector3d& normal) {
  const double inward = -approach.offset.dot(approach.way);
  if (inward <= 0.0) return false;
  const double distance_squared = approach.offset.squaredNorm();
  const double radius_squared = sweep.radius * sweep.radius;
  if (distance_squared < radius_squared) {
    const double distance = std::sqrt(distance_squared);
    const double granted = distance > sweep.floor ? sweep.slack : 0.0;
    if (inward <= granted * distance || distance == 0.0) return false;
    t = 0.0;
    normal = approach.offset / distance;
    return true;
  }
  const double way_squared = approach.way.squaredNorm();
  const double nearest_t = inward / way_squared;
  const Vector3d nearest = approach.offset + nearest_t * approach.way;
  const double half_chord_squared = radius_squared - nearest.squaredNorm();
  if (half_chord_squared <= 0.0) return false;
  t = std::max(0.0, nearest_t - std::sqrt(half_chord_squared / way_squared));
  if (t > limit) return false;
  normal = (approach.offset + t * approach.way).normalized();
  return true;
}

void try_edge(const Vector3d& begin, const Vector3d& end, const Sweep& sweep, double limit,
              TriangleHit& hit, bool& found) {
  const Vector3d edge = end - begin;
  const double length_squared = edge.squaredNorm();
  const Vector3d from = sweep.origin - begin;
  const double along = from.dot(edge) / length_squared;
  const double along_rate = sweep.step.dot(edge) / length_squared;
  const Approach approach{from - along * edge, sweep.step - along_rate * edge};
  double t = 0.0;
  Vector3d normal;
  if (!enters(approach, sweep, found ? hit.t : limit, t, normal)) return;
  const double place = along + t * along_rate;
  if (place < 0.0 || place > 1.0) return;
  hit = {t, normal, false};
  found = true;
}

void try_corner(const Vector3d& corner, const Sweep& sweep, double limit, TriangleHit& hit,
                bool& found) {
  found |= sweep_corner(corner, sweep, found ? hit.t : limit, hit);
}

// Whether both points are farther than `radius` beyond the same side of the triangle.
bool beside(const TriangleView& triangle, const Vector3d& p, const Vector3d& q, double radius) {
  const std::array<const Vector3d*, 4> corners{&triangle.a, &triangle.b, &triangle.c, &triangle.a};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3d edge = *corners[i + 1] - *corners[i];
    const Vector3d inner = triangle.normal.cross(edge);
    const double within = std::max(inner.dot(p - *corners[i]), inner.dot(q - *corners[i]));
    if (within < 0.0 && within * within > radius * radius * inner.squaredNorm()) return true;
  }
  return false;
}

}  // namespace

bool sweep_corner(const Vector3d& corner, const Sweep& sweep, double limit,
                  TriangleHit& hit) noexcept {
  double t = 0.0;
  Vector3d normal;
  if (!enters({sweep.origin - corner, sweep.step}, sweep, limit, t, normal)) return false;
  hit = {t, normal, false};
  return true;
}

bool sweep_triangle(const TriangleView& triangle, const Sweep& sweep, double limit,
                    TriangleHit& hit) noexcept {
  const double r = sweep.radius;
  double begin = triangle.normal.dot(sweep.origin - triangle.a);
  double change = triangle.normal.dot(sweep.step);
  const double side = begin < 0.0 ? -1.0 : 1.0;
  begin *= side;
  change *= side;
  if (begin >= r && begin + change >= r) return false;

  // The face, entered from outside. A start within the radius counts only if the path leads nearer.
  double slab_enter = 0.0;
  if (begin >= r) {
    slab_enter = (begin - r) / -change;
    if (slab_enter > limit) return false;
    if (is_over(triangle, sweep.origin + slab_enter * sweep.step)) {
      hit = {slab_enter, side * triangle.normal, true};
      return true;
    }
  } else if (is_over(triangle, sweep.origin)) {
    const double granted = begin > sweep.floor ? sweep.slack : 0.0;
    if (-change <= granted) return false;
    hit = {0.0, side * triangle.normal, true};
    return true;
  }

  // Otherwise the path can only enter round an edge or a corner, within the slab.
  const double slab_leave = change < 0.0 ? std::min(1.0, (begin + r) / -change) : 1.0;
  if (beside(triangle, sweep.origin + slab_enter * sweep.step,
             sweep.origin + slab_leave * sweep.step, 1.001 * r)) {
    return false;
  }
  bool found = false;
  try_edge(triangle.a, triangle.b, sweep, limit, hit, found);
  try_edge(triangle.b, triangle.c, sweep, limit, hit, found);
  try_edge(triangle.c, triangle.a, sweep, limit, hit, found);
  try_corner(triangle.a, sweep, limit, hit, found);
  try_corner(triangle.b, sweep, limit, hit, found);
  try_corner(triangle.c, sweep, limit, hit, found);
  return found;
}

// Region tests after C. Ericson, Real-Time Collision Detection, 5.1.5.
Vector3d closest_on_triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c,
                             const Vector3d& p) noexcept {
  const Vector3d ab = b - a;
  const Vector3d ac = c - a;
  const Vector3d ap = p - a;
  const double d1 = ab.dot(ap);
  const double d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0) return a;
  const Vector3d bp = p - b;
  const double d3 = ab.dot(bp);
  const double d4 = ac.dot(bp);
  if (d3 >= 0.0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return a + d1 / (d1 - d3) * ab;
  const Vector3d cp = p - c;
  const double d5 = ab.dot(cp);
  const double d6 = ac.dot(cp);
  if (d6 >= 0.0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return a + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 >= d3 && d5 >= d6) {
    return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  }
  const double sum = va + vb + vc;
  return a + vb / sum * ab + vc / sum * ac;
}

// Moeller and Trumbore; scale-free: only exact parallelism is refused.
bool ray_crosses(const TriangleView& triangle, const Vector3d& p,
                 const Vector3d& direction) noexcept {
  const Vector3d ab = triangle.b - triangle.a;
  const Vector3d ac = triangle.c - triangle.a;
  const Vector3d q = direction.cross(ac);
  const double determinant = ab.dot(q);
  if (determinant == 0.0) return false;
  const Vector3d from = p - triangle.a;
  const double u = from.dot(q) / determinant;
  if (u < 0.0 || u > 1.0) return false;
  const Vector3d r = from.cross(ab);
  const double v = direction.dot(r) / determinant;
  if (v < 0.0 || u + v > 1.0) return false;
  return ac.dot(r) / determinant > 0.0;
}

}  // namespace reckon::haptics
