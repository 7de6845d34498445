// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/queries/mesh_gap.hpp"

#include <algorithm>
#include <limits>

#include "reckon/haptics/queries/tree_search.hpp"

namespace reckon::haptics {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

Hull hull_of(const Triangle& t) { return Hull::of_triangle(t.a, t.b, t.c); }

Hull hull_of(const Triangle& t, const Placement& at) {
  return Hull::of_triangle(at.to_scene(t.a), at.to_scene(t.b), at.to_scene(t.c));
}

// Lower bound of the distance of two boxes along the axes of both.
class BoxBound {
 public:
  explicit BoxBound(const OrientedBox& box)
      : box_(box), inverse_(box.axes.transpose()), slant_(inverse_.cwiseAbs()) {
    const Vector3d reach = box.axes.cwiseAbs() * box.half;
    around_ = {box.centre - reach, box.centre + reach};
  }
  double operator()(const AlignedBox3d& other) const {
    const Vector3d along = (inverse_ * (other.center() - box_.centre)).cwiseAbs();
    const Vector3d reach = box_.half + slant_ * (0.5 * other.sizes());
    return std::max(around_.exteriorDistance(other), (along - reach).cwiseMax(0.0).norm());
  }

 private:
  const OrientedBox& box_;
  Eigen::Matrix3d inverse_, slant_;
  AlignedBox3d around_;
};

// Whether all corners are farther than `limit` beyond one side of the triangle's plane.
bool beyond_plane(const Triangle& t, const Hull& hull, double limit) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (std::size_t i = 0; i < hull.count; ++i) {
    const double height = t.normal.dot(hull.corners[i] - t.a);
    low = std::min(low, height);
    high = std::max(high, height);
  }
  return std::max(low, -high) > limit;
}

}  // namespace

HullGap mesh_box_gap(const SurfaceMesh& mesh, const OrientedBox& box,
                     std::uint32_t& triangle) noexcept {
  const Hull core = Hull::of_box(box.centre, box.axes, box.half);
  const TriangleList& triangles = mesh.triangles();
  HullGap best;
  best.distance = std::numeric_limits<double>::infinity();
  double limit = best.distance;
  const auto visit_one = [&](std::uint32_t i) {
    if (beyond_plane(triangles[i], core, limit)) return;
    HullStart start;
    const HullGap gap = hull_gap(hull_of(triangles[i]), core, start);
    if (!(gap.distance < best.distance)) return;
    best = gap;
    triangle = i;
    limit = gap.distance;
  };
  if (triangle < triangles.size()) visit_one(triangle);
  search_tree(mesh.tree(), limit, BoxBound(box), [&](std::uint32_t first, std::uint32_t count) {
    for (std::uint32_t i = first; i < first + count; ++i) visit_one(i);
  });
  return best;
}

HullGap mesh_mesh_gap(const SurfaceMesh& a, const SurfaceMesh& b, const Placement& b_at,
                      std::uint32_t& hint_a, std::uint32_t& hint_b) noexcept {
  HullGap best;
  best.distance = std::numeric_limits<double>::infinity();
  double limit = best.distance;
  const auto visit_one = [&](std::uint32_t i, std::uint32_t j, const Hull& other) {
    if (beyond_plane(a.triangles()[i], other, limit)) return;
    HullStart start;
    const HullGap gap = hull_gap(hull_of(a.triangles()[i]), other, start);
    if (!(gap.distance < best.distance)) return;
    best = gap;
    hint_a = i;
    hint_b = j;
    limit = gap.distance;
  };
  if (hint_a < a.triangles().size() && hint_b < b.triangles().size())
    visit_one(hint_a, hint_b, hull_of(b.triangles()[hint_b], b_at));
  const Eigen::Matrix3d slant = b_at.orientation.cwiseAbs();
  const auto bound = [&](const AlignedBox3d& one, const AlignedBox3d& other) {
    const Vector3d middle = b_at.to_scene(other.center());
    const Vector3d reach = slant * (0.5 * other.sizes());
    return one.exteriorDistance(AlignedBox3d(middle - reach, middle + reach));
  };
  search_trees(a.tree(), b.tree(), limit, bound,
               [&](std::uint32_t first_a, std::uint32_t count_a, std::uint32_t first_b,
                   std::uint32_t count_b) {
                 for (std::uint32_t j = first_b; j < first_b + count_b; ++j) {
                   const Hull other = hull_of(b.triangles()[j], b_at);
                   for (std::uint32_t i = first_a; i < first_a + count_a; ++i)
                     visit_one(i, j, other);
                 }
               });
  return best;
}

Vector3d lowest_corner(const SurfaceMesh& mesh, const Vector3d& up) noexcept {
  const Vector3d slope = up.cwiseAbs();
  double least = std::numeric_limits<double>::infinity();
  Vector3d lowest = mesh.triangles().front().a;
  search_tree(
      mesh.tree(), least,
      [&](const AlignedBox3d& box) { return up.dot(box.center()) - slope.dot(0.5 * box.sizes()); },
      [&](std::uint32_t first, std::uint32_t count) {
        for (std::uint32_t i = first; i < first + count; ++i) {
          const Triangle& t = mesh.triangles()[i];
          for (const Vector3d* corner : {&t.a, &t.b, &t.c}) {
            if (!(up.dot(*corner) < least)) continue;
            least = up.dot(*corner);
            lowest = *corner;
          }
        }
      });
  return lowest;
}

}  // namespace reckon::haptics
