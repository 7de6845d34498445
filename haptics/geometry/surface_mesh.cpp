// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/geometry/surface_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "reckon/haptics/geometry/mesh_repair.hpp"
#include "reckon/haptics/geometry/shapes.hpp"
#include "reckon/haptics/geometry/vertex_corners.hpp"
#include "reckon/haptics/input_files/load_progress.hpp"

namespace reckon::haptics {

namespace {

using Eigen::Vector3d;
using Index3 = std::array<std::uint32_t, 3>;

// Thinner triangles have no usable normal; the sweep radius of their neighbours covers them.
constexpr double kRelativeThinnest = 1e-10;
// Greatest distance between sweeps for a list of near triangles, in margins; a greater one is a
// jump.
constexpr double kNearby = 4.0;
// Distance of the list's centre ahead of the probe, in margins.
constexpr double kAhead = 0.5;

// Above the rounding of a square, so that most distances need no root.
constexpr double kAbove = 1.0 + 1e-14;

void check(const std::vector<Vector3d>& vertices, const std::vector<Index3>& triangles) {
  for (const Vector3d& v : vertices) {
    if (!v.allFinite()) throw std::runtime_error("a vertex is not finite; repair the mesh");
  }
  for (const Index3& t : triangles) {
    if (*std::max_element(t.begin(), t.end()) >= vertices.size()) {
      throw std::runtime_error(
          "a triangle refers to a vertex that does not exist; repair the mesh");
    }
  }
}

double thickness(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const double longest =
      std::sqrt(std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()}));
  return longest > 0.0 ? (b - a).cross(c - a).norm() / longest : 0.0;
}

TriangleSoup soup_of(std::vector<Vector3d> vertices, const std::vector<Index3>& indices) {
  check(vertices, indices);
  TriangleSoup soup{std::move(vertices), {}, {}};
  soup.triangles.reserve(indices.size());
  for (const Index3& corners : indices) {
    soup.triangles.push_back({corners, static_cast<std::uint32_t>(soup.triangles.size() + 1), {}});
  }
  return soup;
}

MeshReport report_of(const std::vector<Index3>& indices) {
  MeshReport report;
  report.faces = indices.size();
  return report;
}

// Drops thin triangles; their neighbours cover the place.
void drop_thin(TriangleSoup& soup, double thinnest, MeshReport& report) {
  std::erase_if(soup.triangles, [&](const SoupTriangle& triangle) {
    const auto& t = triangle.corners;
    const bool thin =
        !(thickness(soup.vertices[t[0]], soup.vertices[t[1]], soup.vertices[t[2]]) > thinnest);
    if (thin) report.dropped_degenerate.add(triangle.place);
    return thin;
  });
}

std::runtime_error no_triangle(const MeshReport& report) {
  if (report.faces == 0) return std::runtime_error("has no triangle; give a mesh with faces");
  return std::runtime_error("has no usable triangle: of " + std::to_string(report.faces) +
                            " faces, none has an area; give a mesh with faces");
}

}  // namespace

SurfaceMesh::SurfaceMesh(std::vector<Vector3d> vertices, std::vector<Index3> indices)
    : SurfaceMesh(soup_of(std::move(vertices), indices), report_of(indices)) {}

SurfaceMesh::SurfaceMesh(TriangleSoup soup, MeshReport report)
    : report_(std::move(report)), names_(std::move(soup.names)) {
  if (soup.triangles.size() > kMostTriangles) throw std::runtime_error("more than 2^30 triangles");
  weld(soup, report_);
  drop_collapsed(soup, report_);
  LoadProgress::look_now();
  VertexCorners corners(soup);
  if (drop_duplicates(soup, corners, report_)) corners = VertexCorners(soup);
  LoadProgress::look_now();
  for (const SoupTriangle& triangle : soup.triangles) {
    for (const std::uint32_t corner : triangle.corners) bounds_.extend(soup.vertices[corner]);
  }
  if (bounds_.isEmpty()) throw no_triangle(report_);
  size_ = bounds_.sizes().norm();
  clearance_ = kRelativeClearance * size_;
  report_.extent = bounds_.sizes();
  orient(soup, std::move(corners), report_);
  LoadProgress::look_now();
  drop_thin(soup, kRelativeThinnest * size_, report_);
  if (soup.triangles.empty()) throw no_triangle(report_);
  report_.triangles = soup.triangles.size();
  plant(soup);
}

void SurfaceMesh::plant(TriangleSoup& soup) {
  const auto box_of = [&](std::size_t item) {
    Eigen::AlignedBox3d box;
    for (const std::uint32_t corner : soup.triangles[item].corners) {
      box.extend(soup.vertices[corner]);
    }
    return box;
  };
  tree_ = BoundingVolumeTree(soup.triangles.size(), box_of, 2.0 * clearance_);
  {
    const std::vector<std::uint32_t> order = tree_.take_order();
    if (!names_.empty()) {
      face_names_.reserve(order.size());
      for (const std::uint32_t item : order) face_names_.push_back(soup.triangles[item].names);
    }
    triangles_ = TriangleList(soup, order);
  }
  triangle_bounds_ = TriangleBounds(triangles_, bounds_.center(), size_);
}

namespace {

// The distance from a triangle is a convex function of time and so stays above its tangent at the
// start. That excludes most triangles near a ball by one point instead of seven features.
bool stays_clear(const TriangleView& triangle, const Sweep& way, double limit) noexcept {
  const Vector3d gap = way.origin - closest_on_triangle(triangle, way.origin);
  const double distance = gap.norm();
  // More than rounding, so that the hit does not depend on earlier ones.
  const double room = distance - (1.0 + 1e-11) * way.radius;
  if (!(room > 0.0)) return false;
  const double fall = -gap.dot(way.step) * limit;
  return (1.0 - 1e-9) * distance * room > fall;
}

}  // namespace

/// The first triangle that a sweep meets, for any order of the candidates.
struct SurfaceMesh::FirstHit {
  const SurfaceMesh& mesh;
  Sweep way;
  bool ball;
  SweepHit& hit;
  double limit;
  bool found = false;
  TriangleBounds::Segment segment;  // path of a point
  TriangleBounds::Place from;       // start of a ball
  double reach = 0.0;               // [m], range of a ball on its path

  FirstHit(const SurfaceMesh& on, const Vector3d& origin, const Vector3d& step, double radius,
           double most, SweepHit& out) noexcept
      : mesh(on),
        way{origin, step, radius + on.sweep_radius(), radius + 0.5 * on.sweep_radius(),
            kSlideSlack * on.clearance()},
        ball(radius > 0.0),
        hit(out),
        limit(most) {
    if (ball) from = mesh.triangle_bounds_.place(origin);
    look_as_far_as_limit();
  }

  void look_as_far_as_limit() noexcept {
    if (ball) {
      reach = way.radius + limit * way.step.norm();
    } else {
      segment =
          mesh.triangle_bounds_.segment(way.origin, way.origin + limit * way.step, way.radius);
    }
  }

  // Whether triangle i is the first so far. The search calls it for each triangle.
  [[gnu::always_inline]] bool meet(std::uint32_t i) noexcept {
    if (ball ? mesh.triangle_bounds_.beyond(i, from, reach)
             : mesh.triangle_bounds_.beside(i, segment)) {
      return false;
    }
    const TriangleView triangle = mesh.triangles_.view(i);
    if (ball && stays_clear(triangle, way, limit)) return false;
    TriangleHit one;
    if (!sweep_triangle(triangle, way, limit, one)) return false;
    if (found && (one.t > limit || (one.t == limit && i > hit.triangle))) return false;
    hit = {one.t, one.normal, mesh.clearance() - mesh.sweep_radius(), i, 0, one.on_face};
    limit = one.t;
    found = true;
    look_as_far_as_limit();
    return true;
  }
};

bool SurfaceMesh::sweep(const Vector3d& origin, const Vector3d& step, double radius,
                        SweepHit& hit) const noexcept {
  FirstHit first(*this, origin, step, radius, 1.0, hit);
  const auto visit = [&](std::uint32_t begin, std::uint32_t count) {
    for (std::uint32_t i = begin; i < begin + count; ++i) first.meet(i);
  };
  if (radius * radius > step.squaredNorm()) {
    tree_.along_ball(origin, step, first.way.radius, first.limit, visit);
  } else {
    tree_.along_segment(origin, step, radius, first.limit, visit);
  }
  return first.found;
}

namespace {

// Share of the step, at most 1, after which the path from `offset` by `step` leaves the ball of
// `radius` around the origin. The path begins inside.
double share_within(const Vector3d& offset, const Vector3d& step, double radius) noexcept {
  if ((offset + step).squaredNorm() <= radius * radius) return 1.0;
  const double along = offset.dot(step);
  const double squared = step.squaredNorm();
  const double room = radius * radius - offset.squaredNorm();
  return std::clamp((std::sqrt(along * along + squared * room) - along) / squared, 0.0, 1.0);
}

}  // namespace

// The list is complete while the probe is within its reach. No point of the path is farther from
// the centre than the farther end.
bool SurfaceMesh::sweep(const Vector3d& origin, const Vector3d& step, double radius,
                        NearTriangles& near, SweepHit& hit) const noexcept {
  const double stop = radius + sweep_radius();
  if (!((origin - near.centre_).norm() < near.room(stop)) && !list_near(origin, stop, near)) {
    return sweep(origin, step, radius, hit);
  }
  const Vector3d offset = origin - near.centre_;
  const double within = share_within(offset, step, near.room(stop));
  FirstHit first(*this, origin, step, radius, within, hit);
  const double begin = offset.squaredNorm();
  double reach = std::sqrt(std::max(begin, (offset + within * step).squaredNorm())) + stop;
  for (std::size_t i = 0; i < near.count_ && near.away_[i] <= reach; ++i) {
    if (!first.meet(near.triangles_[i])) continue;
    reach = std::sqrt(std::max(begin, (offset + first.limit * step).squaredNorm())) + stop;
  }
  return first.found || (within < 1.0 && sweep(origin, step, radius, hit));
}

// A list pays if sweeps begin near each other and few triangles are near. The margin adapts to
// that. The centre of the list is ahead, because a hand mostly continues its motion.
bool SurfaceMesh::list_near(const Vector3d& p, double stop, NearTriangles& near) const noexcept {
  const double usual = size_ / std::sqrt(static_cast<double>(triangles_.size()));
  if (near.margin_ == 0.0) near.margin_ = usual;
  const Vector3d way = p - near.centre_;
  const double moved = way.norm();
  near.centre_ = p;
  near.reach_ = -1.0;
  if (!(moved <= kNearby * near.margin_)) {
    near.margin_ = std::max(near.margin_, std::min(2.0 * near.margin_, usual));
    return false;
  }
  near.count_ = 0;
  if (moved > 0.0) near.centre_ += std::min(1.0, kAhead * near.margin_ / moved) * way;
  bool room = true;
  double reach = stop + near.margin_;
  const TriangleBounds::Place place = triangle_bounds_.place(near.centre_);
  const auto visit = [&](std::uint32_t first, std::uint32_t count) {
    for (std::uint32_t i = first; i < first + count && room; ++i) {
      const float away = triangle_bounds_.distance_below(i, place);
      if (away <= reach) room = near.add(i, away);
    }
    if (!room) reach = 0.0;
  };
  tree_.near_point(near.centre_, reach, visit, [&](std::uint32_t first, std::uint32_t count) {
    triangle_bounds_.fetch(first, count);
  });
  if (!room) {
    near.margin_ *= 0.5;
    return false;
  }
  near.reach_ = reach;
  if (near.count_ < NearTriangles::kMost / 3) near.margin_ = std::min(1.5 * near.margin_, size_);
  return true;
}

bool SurfaceMesh::closest(const Vector3d& p, double limit, ClosestPoint& out,
                          double precision) const noexcept {
  return closest_below(p, limit, precision, false, out);
}

bool SurfaceMesh::closest_from(const Vector3d& p, std::uint32_t hint, ClosestPoint& out,
                               double precision) const noexcept {
  const Vector3d candidate = closest_on_triangle(triangles_.view(hint), p);
  out = {candidate, (candidate - p).norm(), hint};
  return closest_below(p, out.distance, precision, true, out);
}

// After a first point, only points nearer by more than the precision are examined.
bool SurfaceMesh::closest_below(const Vector3d& p, double limit, double precision, bool found,
                                ClosestPoint& out) const noexcept {
  const TriangleBounds::Place place = triangle_bounds_.place(p);
  double reach = found ? std::max(0.0, limit - precision) : limit;
  tree_.near_point(
      p, reach,
      [&](std::uint32_t first, std::uint32_t count) {
        for (std::uint32_t i = first; i < first + count; ++i) {
          if (triangle_bounds_.beyond(i, place, reach)) continue;
          const Vector3d candidate = closest_on_triangle(triangles_.view(i), p);
          const double squared = (candidate - p).squaredNorm();
          if (squared > kAbove * limit * limit) continue;
          const double distance = std::sqrt(squared);
          if (!(distance < limit)) continue;
          out = {candidate, distance, i};
          limit = distance;
          reach = std::max(0.0, limit - precision);
          found = true;
        }
      },
      [&](std::uint32_t first, std::uint32_t count) { triangle_bounds_.fetch(first, count); });
  return found;
}

bool SurfaceMesh::closest_near(const Vector3d& p, NearTriangles& near,
                               ClosestPoint& out) const noexcept {
  const Vector3d candidate = closest_on_triangle(triangles_.view(near.nearest_), p);
  out = {candidate, (candidate - p).norm(), near.nearest_};
  if ((p - near.centre_).norm() < near.room(out.distance) || list_near(p, out.distance, near)) {
    const double moved = (p - near.centre_).norm();
    const TriangleBounds::Place place = triangle_bounds_.place(p);
    for (std::size_t k = 0; k < near.count_ && near.away_[k] <= moved + out.distance; ++k) {
      const std::uint32_t i = near.triangles_[k];
      if (triangle_bounds_.beyond(i, place, out.distance)) continue;
      const Vector3d on = closest_on_triangle(triangles_.view(i), p);
      const double squared = (on - p).squaredNorm();
      if (squared > kAbove * out.distance * out.distance) continue;
      const double distance = std::sqrt(squared);
      if (distance < out.distance) out = {on, distance, i};
    }
  } else {
    closest_from(p, near.nearest_, out);
  }
  near.nearest_ = out.triangle;
  return true;
}

bool SurfaceMesh::over(std::uint32_t triangle, const Vector3d& p) const noexcept {
  return is_over(triangles_.view(triangle), p);
}

bool SurfaceMesh::odd_crossings(const Vector3d& p, const Vector3d& ray) const noexcept {
  bool odd = false;
  const Vector3d way = 2.0 * size_ * ray;
  const double whole_way = 1.0;
  tree_.along_segment(p, way, 0.0, whole_way, [&](std::uint32_t first, std::uint32_t count) {
    for (std::uint32_t i = first; i < first + count; ++i)
      odd ^= ray_crosses(triangles_.view(i), p, way);
  });
  return odd;
}

bool SurfaceMesh::contains(const Vector3d& p) const noexcept {
  if (!report_.closed || !bounds_.contains(p)) return false;
  // Directions along no likely symmetry: a ray through an edge may fail, but not two of three.
  const std::array<Vector3d, 3> rays{Vector3d(0.5417, 0.6231, 0.5641),
                                     Vector3d(-0.7309, 0.1847, 0.6570),
                                     Vector3d(0.2213, -0.8713, 0.4381)};
  int votes = 0;
  for (const Vector3d& ray : rays) votes += odd_crossings(p, ray) ? 1 : 0;
  return votes >= 2;
}

}  // namespace reckon::haptics
