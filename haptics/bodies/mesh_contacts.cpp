// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/bodies/mesh_contacts.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace reckon::haptics {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kSpacing = 0.0625;  // spacing of points along an edge, over the size of the mesh

struct Place {
  Vector3d at;
  Quaterniond turned;
};

Place place_of(dGeomID geom) noexcept {
  dQuaternion q;
  dGeomGetQuaternion(geom, q);
  const dReal* p = dGeomGetPosition(geom);
  return {{p[0], p[1], p[2]}, {q[0], q[1], q[2], q[3]}};
}

bool before(const Vector3d& a, const Vector3d& b) {
  return std::ranges::lexicographical_compare(a, b);
}

Vector3d vector(const dReal* v) noexcept { return {v[0], v[1], v[2]}; }

// Finds points of `one` inside `other`. @param way sign of the normals: 1 if `one` is the first
// geom
void find(const ProbedMesh& one, const Place& one_at, const ProbedMesh& other,
          const Place& other_at, double way, std::span<dContactGeom> out,
          std::size_t& count) noexcept {
  const SurfaceMesh& mesh = other.mesh();
  if (!mesh.report().closed) return;
  const Quaterniond turn = other_at.turned.conjugate() * one_at.turned;
  const Vector3d shift = other_at.turned.conjugate() * (one_at.at - other_at.at);
  for (const Vector3d& point : one.points()) {
    const Vector3d p = turn * point + shift;
    if (!mesh.bounds().contains(p) || !mesh.contains(p)) continue;
    ClosestPoint nearest;
    static_cast<void>(mesh.closest_from(p, 0, nearest));
    if (!(nearest.distance > 0)) continue;
    if (count == out.size()) return;
    const Vector3d normal = way * (other_at.turned * ((nearest.point - p) / nearest.distance));
    const Vector3d at = other_at.turned * p + other_at.at;
    dContactGeom& contact = out[count++];
    for (int k = 0; k < 3; ++k) {
      contact.pos[k] = at[k];
      contact.normal[k] = normal[k];
    }
    contact.depth = nearest.distance;
  }
}

}  // namespace

ProbedMesh::ProbedMesh(std::shared_ptr<const SurfaceMesh> mesh) : mesh_(std::move(mesh)) {
  std::vector<std::array<Vector3d, 2>> edges;
  for (const Triangle& t : mesh_->triangles()) {
    for (const auto& [from, to] : {std::pair(&t.a, &t.b), {&t.b, &t.c}, {&t.c, &t.a}}) {
      corners_.push_back(*from);
      edges.push_back(before(*from, *to) ? std::array{*from, *to} : std::array{*to, *from});
    }
  }
  std::ranges::sort(corners_, before);
  corners_.erase(std::ranges::unique(corners_).begin(), corners_.end());
  points_ = corners_;
  std::ranges::sort(edges, [](const auto& a, const auto& b) {
    return before(a[0], b[0]) || (a[0] == b[0] && before(a[1], b[1]));
  });
  edges.erase(std::ranges::unique(edges).begin(), edges.end());
  for (const auto& [from, to] : edges) {
    const double parts = std::ceil((to - from).norm() / (kSpacing * mesh_->size()));
    for (double i = 1; i < parts; ++i) points_.emplace_back(from + i / parts * (to - from));
  }
  std::ranges::sort(points_, before);
  points_.erase(std::ranges::unique(points_).begin(), points_.end());
  if (points_.size() <= kMostPoints) return;
  for (std::size_t i = 0; i < kMostPoints; ++i)
    points_[i] = points_[i * points_.size() / kMostPoints];
  points_.resize(kMostPoints);
}

std::size_t meet(const ProbedMesh& a, dGeomID a_at, const ProbedMesh& b, dGeomID b_at,
                 std::span<dContactGeom> out) noexcept {
  const Place a_place = place_of(a_at), b_place = place_of(b_at);
  std::size_t count = 0;
  find(a, a_place, b, b_place, 1.0, out, count);
  find(b, b_place, a, a_place, -1.0, out, count);
  return count;
}

std::size_t meet_plane(const ProbedMesh& mesh, dGeomID at, dGeomID plane, bool is_first,
                       std::span<dContactGeom> out) noexcept {
  constexpr std::size_t kWays = 8;
  const Place place = place_of(at);
  dVector4 given;
  dGeomPlaneGetParams(plane, given);
  const Vector3d normal(given[0], given[1], given[2]);
  const Vector3d up = place.turned.conjugate() * normal;
  const double height = given[3] - normal.dot(place.at);  // height of the plane, in the mesh's axes
  const Eigen::AlignedBox3d& box = mesh.mesh().bounds();
  if (up.dot(box.center()) - 0.5 * up.cwiseAbs().dot(box.sizes()) > height) return 0;
  const Vector3d along = up.unitOrthogonal(), across = up.cross(along);
  // The deepest corner, then the farthest in each direction.
  std::array<const Vector3d*, kWays + 1> found{};
  std::array<double, kWays + 1> most;
  most.fill(-std::numeric_limits<double>::infinity());
  const auto note = [&](std::size_t i, double size, const Vector3d& corner) {
    if (!(size > most[i])) return;
    most[i] = size;
    found[i] = &corner;
  };
  for (const Vector3d& corner : mesh.corners()) {
    const double depth = height - up.dot(corner);
    if (!(depth > 0)) continue;
    note(0, depth, corner);
    const double a = along.dot(corner), b = across.dot(corner);
    const std::array<double, 4> sizes{a, b, a + b, a - b};
    for (std::size_t i = 0; i < 4; ++i) {
      note(1 + i, sizes[i], corner);
      note(5 + i, -sizes[i], corner);
    }
  }
  std::size_t count = 0;
  for (std::size_t i = 0; i < found.size() && count < out.size(); ++i) {
    if (found[i] == nullptr ||
        std::find(found.begin(), found.begin() + i, found[i]) != found.begin() + i)
      continue;
    const Vector3d point = place.turned * *found[i] + place.at;
    dContactGeom& contact = out[count++];
    for (int k = 0; k < 3; ++k) {
      contact.pos[k] = point[k];
      contact.normal[k] = is_first ? normal[k] : -normal[k];
    }
    contact.depth = height - up.dot(*found[i]);
  }
  return count;
}

std::size_t keep_widest(std::span<dContactGeom> contacts) noexcept {
  if (contacts.size() <= 4) return contacts.size();
  const auto bring = [&](std::size_t to, auto size_of) {
    std::size_t best = to;
    double most = size_of(contacts[to]);
    for (std::size_t i = to + 1; i < contacts.size(); ++i) {
      const double size = size_of(contacts[i]);
      if (!(size > most)) continue;
      best = i;
      most = size;
    }
    std::swap(contacts[to], contacts[best]);
  };
  bring(0, [](const dContactGeom& c) { return c.depth; });
  const Vector3d first = vector(contacts[0].pos), normal = vector(contacts[0].normal);
  bring(1, [&](const dContactGeom& c) { return (vector(c.pos) - first).squaredNorm(); });
  const Vector3d across = normal.cross(vector(contacts[1].pos) - first);
  bring(2, [&](const dContactGeom& c) { return std::abs(across.dot(vector(c.pos) - first)); });
  const double side = across.dot(vector(contacts[2].pos) - first);
  bring(3, [&](const dContactGeom& c) { return -side * across.dot(vector(c.pos) - first); });
  return 4;
}

}  // namespace reckon::haptics
