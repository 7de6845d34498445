// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/geometry/surface_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>
#include <unordered_map>

#include "reckon/haptics/geometry/shapes.hpp"

namespace reckon::haptics {

namespace {

using Eigen::Vector3d;
using Index3 = std::array<std::uint32_t, 3>;

// Thinner triangles have no usable normal; the sweep radius of their neighbours covers them.
constexpr double kRelativeThinnest = 1e-10;

struct PositionHash {
  std::size_t operator()(const Vector3d& p) const noexcept {
    std::uint64_t hash = 1469598103934665603ull;
    for (Eigen::Index i = 0; i < 3; ++i) {
      const double value = p[i] + 0.0;  // -0 becomes 0
      std::uint64_t bits = 0;
      std::memcpy(&bits, &value, sizeof bits);
      hash = (hash ^ bits) * 0x9E3779B97F4A7C15ull;
      hash ^= hash >> 29;
    }
    return static_cast<std::size_t>(hash);
  }
};

void check(const std::vector<Vector3d>& vertices, const std::vector<Index3>& triangles) {
  for (const Vector3d& v : vertices) {
    if (!v.allFinite()) throw std::runtime_error("a vertex is not finite; mend the mesh");
  }
  for (const Index3& t : triangles) {
    if (*std::max_element(t.begin(), t.end()) >= vertices.size()) {
      throw std::runtime_error("a triangle names a vertex that does not exist; mend the mesh");
    }
  }
  if (triangles.size() > 0x7fffffffu) throw std::runtime_error("more than 2^31 triangles");
}

// Vertices at the same position become one.
std::size_t weld(const std::vector<Vector3d>& vertices, std::vector<Index3>& triangles) {
  std::unordered_map<Vector3d, std::uint32_t, PositionHash> first;
  first.reserve(vertices.size());
  std::vector<std::uint32_t> same(vertices.size());
  for (std::uint32_t i = 0; i < vertices.size(); ++i)
    same[i] = first.emplace(vertices[i], i).first->second;
  for (Index3& t : triangles) {
    for (std::uint32_t& corner : t) corner = same[corner];
  }
  return first.size();
}

double thickness(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const double longest =
      std::sqrt(std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()}));
  return longest > 0.0 ? (b - a).cross(c - a).norm() / longest : 0.0;
}

// A thin sliver of three distinct corners still joins its neighbours: it counts as topology.
void drop_collapsed(std::vector<Index3>& triangles) {
  std::erase_if(triangles,
                [](const Index3& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
}

void count_edges(const std::vector<Index3>& triangles, MeshReport& report) {
  struct Uses {
    std::uint32_t forward = 0, backward = 0;
  };
  std::unordered_map<std::uint64_t, Uses> edges;
  edges.reserve(triangles.size() * 2);
  for (const Index3& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint64_t from = t[i];
      const std::uint64_t to = t[(i + 1) % 3];
      Uses& uses = edges[std::min(from, to) << 32 | std::max(from, to)];
      ++(from < to ? uses.forward : uses.backward);
    }
  }
  for (const auto& [key, uses] : edges) {
    const std::uint32_t total = uses.forward + uses.backward;
    if (total == 1) ++report.boundary_edges;
    if (total > 2) ++report.non_manifold_edges;
    if (total == 2 && uses.forward != 1) ++report.inconsistent_edges;
  }
  report.closed = report.boundary_edges == 0 && report.non_manifold_edges == 0;
}

double signed_volume(const std::vector<Vector3d>& vertices, const std::vector<Index3>& triangles,
                     const Vector3d& origin) {
  double six_volumes = 0.0;
  for (const Index3& t : triangles) {
    six_volumes +=
        (vertices[t[0]] - origin).dot((vertices[t[1]] - origin).cross(vertices[t[2]] - origin));
  }
  return six_volumes / 6.0;
}

}  // namespace

SurfaceMesh::SurfaceMesh(std::vector<Vector3d> vertices, std::vector<Index3> indices) {
  check(vertices, indices);
  const std::size_t given = indices.size();
  report_.vertices = weld(vertices, indices);
  drop_collapsed(indices);
  count_edges(indices, report_);
  for (const Index3& t : indices) {
    for (const std::uint32_t corner : t) bounds_.extend(vertices[corner]);
  }
  if (bounds_.isEmpty()) throw std::runtime_error("the mesh has no triangle");
  size_ = bounds_.sizes().norm();
  clearance_ = kRelativeClearance * size_;

  report_.volume = signed_volume(vertices, indices, bounds_.center());
  report_.flipped = report_.closed && report_.volume < 0.0;
  std::erase_if(indices, [&](const Index3& t) {
    return !(thickness(vertices[t[0]], vertices[t[1]], vertices[t[2]]) > kRelativeThinnest * size_);
  });
  report_.triangles = indices.size();
  report_.dropped_degenerate = given - indices.size();
  if (indices.empty()) throw std::runtime_error("every triangle of the mesh is degenerate");

  std::vector<Eigen::AlignedBox3d> boxes(indices.size());
  for (std::size_t i = 0; i < indices.size(); ++i) {
    for (const std::uint32_t corner : indices[i]) boxes[i].extend(vertices[corner]);
  }
  tree_ = BoundingVolumeTree(boxes, 2.0 * clearance_);
  triangles_.reserve(indices.size());
  for (const std::uint32_t item : tree_.order()) {
    Index3 t = indices[item];
    if (report_.flipped) std::swap(t[1], t[2]);
    const Vector3d& a = vertices[t[0]];
    const Vector3d& b = vertices[t[1]];
    const Vector3d& c = vertices[t[2]];
    triangles_.push_back({a, b, c, (b - a).cross(c - a).normalized()});
  }
}

namespace {

// The distance from a triangle is a convex function of time and so stays above its tangent at the
// start: of the triangles near a ball most are told so, by one point instead of seven features.
bool stays_clear(const Triangle& triangle, const Sweep& way, double limit) noexcept {
  const Vector3d gap = way.origin - closest_on_triangle(triangle, way.origin);
  const double distance = gap.norm();
  if (!(distance > way.radius)) return false;
  const double fall = -gap.dot(way.step) * limit;
  return (1.0 - 1e-12) * distance * (distance - way.radius) > fall;
}

}  // namespace

bool SurfaceMesh::sweep(const Vector3d& origin, const Vector3d& step, double radius,
                        SweepHit& hit) const noexcept {
  const double stop = radius + sweep_radius();
  const Sweep way{origin, step, stop, radius + 0.5 * sweep_radius(), kSlideSlack * clearance_};
  double limit = 1.0;
  bool found = false;
  const auto visit = [&](std::uint32_t first, std::uint32_t count) {
    for (std::uint32_t i = first; i < first + count; ++i) {
      if (radius > 0.0 && stays_clear(triangles_[i], way, limit)) continue;
      TriangleHit one;
      if (!sweep_triangle(triangles_[i], way, limit, one)) continue;
      if (found && one.t >= limit) continue;
      hit = {one.t, one.normal, clearance_ - sweep_radius(), i, 0, one.on_face};
      limit = one.t;
      found = true;
    }
  };
  if (radius * radius > step.squaredNorm()) {
    tree_.along_ball(origin, step, stop, limit, visit);
  } else {
    tree_.along_segment(origin, step, radius, limit, visit);
  }
  return found;
}

bool SurfaceMesh::closest(const Vector3d& p, double limit, ClosestPoint& out) const noexcept {
  return closest_below(p, limit, false, out);
}

bool SurfaceMesh::closest_from(const Vector3d& p, std::uint32_t hint,
                               ClosestPoint& out) const noexcept {
  const Vector3d candidate = closest_on_triangle(triangles_[hint], p);
  out = {candidate, (candidate - p).norm(), hint};
  return closest_below(p, out.distance, true, out);
}

bool SurfaceMesh::closest_below(const Vector3d& p, double limit, bool found,
                                ClosestPoint& out) const noexcept {
  tree_.near_point(p, limit, [&](std::uint32_t first, std::uint32_t count) {
    for (std::uint32_t i = first; i < first + count; ++i) {
      const Triangle& triangle = triangles_[i];
      // No point of it is nearer than its plane.
      if ((1.0 - 1e-12) * std::abs(triangle.normal.dot(p - triangle.a)) >= limit) continue;
      const Vector3d candidate = closest_on_triangle(triangles_[i], p);
      const double distance = (candidate - p).norm();
      if (!(distance < limit)) continue;
      out = {candidate, distance, i};
      limit = distance;
      found = true;
    }
  });
  return found;
}

bool SurfaceMesh::over(std::uint32_t triangle, const Vector3d& p) const noexcept {
  return is_over(triangles_[triangle], p);
}

bool SurfaceMesh::odd_crossings(const Vector3d& p, const Vector3d& ray) const noexcept {
  bool odd = false;
  const Vector3d way = 2.0 * size_ * ray;
  const double whole_way = 1.0;
  tree_.along_segment(p, way, 0.0, whole_way, [&](std::uint32_t first, std::uint32_t count) {
    for (std::uint32_t i = first; i < first + count; ++i) odd ^= ray_crosses(triangles_[i], p, way);
  });
  return odd;
}

bool SurfaceMesh::contains(const Vector3d& p) const noexcept {
  if (!report_.closed || !bounds_.contains(p)) return false;
  // Directions along no likely symmetry; a ray through an edge may err, two of three may not.
  const std::array<Vector3d, 3> rays{Vector3d(0.5417, 0.6231, 0.5641),
                                     Vector3d(-0.7309, 0.1847, 0.6570),
                                     Vector3d(0.2213, -0.8713, 0.4381)};
  int votes = 0;
  for (const Vector3d& ray : rays) votes += odd_crossings(p, ray) ? 1 : 0;
  return votes >= 2;
}

}  // namespace reckon::haptics
