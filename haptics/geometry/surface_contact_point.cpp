// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/geometry/surface_contact_point.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "reckon/haptics/geometry/constraint_planes.hpp"

namespace reckon::haptics {

namespace {

using Eigen::Vector3d;
using MeshPointer = std::shared_ptr<const SurfaceMesh>;

// Shortest move worth making, in clearances: below it the SCP counts as settled.
constexpr double kTinyMove = 1e-3;
// How far above a face it may hover and still be held by it, in clearances.
constexpr double kHeldHeight = 1.01;

}  // namespace

/// One update on a mesh: planes found so far, and the SCP on its way.
struct SurfaceContactPoint::MeshWalk {
  const SurfaceMesh& mesh;
  const Vector3d& device;
  FrictionCone* friction;
  Vector3d p;
  bool sliding = false;
  ConstraintPlanes planes;
  ConstraintSolution solution;
  Vector3d released_at = Vector3d::Zero();
  bool released = false;

  [[nodiscard]] double height(std::uint32_t triangle) const noexcept {
    const Triangle& t = mesh.triangles()[triangle];
    return t.normal.dot(p - t.a);
  }

  // A face that p hovers over within the clearance, and that lies between p and the device, holds
  // it without any search.
  void add_held(std::uint32_t triangle) noexcept {
    const Triangle& t = mesh.triangles()[triangle];
    const double above = height(triangle);
    const double side = above < 0.0 ? -1.0 : 1.0;
    if (std::abs(above) > kHeldHeight * mesh.clearance()) return;
    if (side * t.normal.dot(device - p) >= 0.0 || !mesh.over(triangle, p)) return;
    const double spare = std::max(0.0, std::abs(above) - mesh.clearance());
    planes.add({side * t.normal, side * t.normal.dot(p) - spare, triangle, true}, p);
  }

  // Stops p one clearance before the surface and notes the plane that it met there.
  void stop_at(const SweepHit& hit, const Vector3d& step) noexcept {
    const double margin = mesh.clearance() - mesh.sweep_radius();
    const double level = hit.normal.dot(p + hit.t * step) + margin;
    const double approach = -hit.normal.dot(step);
    const double t = hit.t - margin / approach;
    if (t > 0.0) move(t * step);
    planes.add({hit.normal, std::min(level, hit.normal.dot(p)), hit.triangle, hit.on_face}, p);
  }

  void move(const Vector3d& step) noexcept {
    if (step.squaredNorm() <= tiny() * tiny()) return;
    if ((p + step - device).squaredNorm() > (p - device).squaredNorm()) return;
    p += step;
    if (planes.size() > 0) sliding = true;
  }

  [[nodiscard]] double tiny() const noexcept { return kTinyMove * mesh.clearance(); }

  // Where the planes and friction let p go; false when it need not or may not move.
  [[nodiscard]] bool next_step(Vector3d& step) noexcept {
    const double tolerance = 1e-12 * (mesh.size() + (device - p).norm());
    if (!planes.solve(device, tolerance, solution)) {
      solution.active_count = 0;
      return false;
    }
    step = solution.point - p;
    if (planes.size() == 0) return p != device;  // however short: only a sweep may let it pass
    if (friction != nullptr) {
      const double lateral = step.norm();
      const double held = friction->held(lateral, solution.load, sliding);
      step = held < lateral ? Vector3d((1.0 - held / lateral) * step) : Vector3d::Zero();
    }
    return step.squaredNorm() > tiny() * tiny();
  }

  // All planes that carry load belong to faces right below p: it is settled, not past an edge.
  [[nodiscard]] bool held_by_faces() const noexcept {
    if (solution.active_count == 0) return false;
    for (std::size_t i = 0; i < solution.active_count; ++i) {
      const ConstraintPlane& plane = planes[solution.active[i]];
      if (!plane.on_face || !mesh.over(plane.triangle, p)) return false;
      if (std::abs(height(plane.triangle)) > kHeldHeight * mesh.clearance()) return false;
    }
    return true;
  }

  // Forgets all planes to see which still hold p; false when that was done here before.
  [[nodiscard]] bool release() noexcept {
    if (released && released_at == p) return false;
    released = true;
    released_at = p;
    planes.clear();
    return true;
  }

  // Goes on until nothing moves any more. @return whether p reached the device freely.
  bool run() noexcept {
    for (int moves = 0; moves < kMaxMoves; ++moves) {
      Vector3d step;
      if (!next_step(step)) {
        if (planes.size() == 0) return true;
        if (held_by_faces() || !release()) return false;
        continue;
      }
      SweepHit hit;
      if (mesh.sweep(p, step, hit)) {
        stop_at(hit, step);
        continue;
      }
      if (planes.size() == 0) {
        p = device;
        return true;
      }
      move(step);
      if (held_by_faces() || !release()) return false;
    }
    return false;
  }
};

void SurfaceContactPoint::set_free(const Vector3d& device) noexcept {
  point_ = {device, Vector3d::Zero(), false};
  face_count_ = 0;
}

void SurfaceContactPoint::update(const ContactShape& shape, const Vector3d& device,
                                 FrictionCone* friction) noexcept {
  std::visit(
      [&](const auto& solid) {
        if constexpr (std::is_same_v<std::decay_t<decltype(solid)>, MeshPointer>) {
          update_mesh(*solid, device, friction);
        } else {
          point_ = solid.settle(point_.scp, device, friction);
        }
      },
      shape);
}

void SurfaceContactPoint::update_mesh(const SurfaceMesh& mesh, const Vector3d& device,
                                      FrictionCone* friction) noexcept {
  MeshWalk walk{mesh, device, friction, point_.scp, friction != nullptr && friction->sliding(),
                {},   {}};
  for (std::size_t i = 0; i < face_count_; ++i) walk.add_held(faces_[i]);
  const Vector3d before = walk.p;
  if (walk.run()) {
    set_free(device);
    if (friction != nullptr) friction->set_sliding(false);
    return;
  }
  if (friction != nullptr) friction->set_sliding(walk.sliding && walk.p != before);
  point_.scp = walk.p;
  point_.in_contact = true;
  const double load = walk.solution.push.norm();
  if (load > 0.0) point_.normal = walk.solution.push / load;
  face_count_ = 0;
  for (std::size_t i = 0; i < walk.solution.active_count; ++i) {
    const ConstraintPlane& plane = walk.planes[walk.solution.active[i]];
    if (plane.on_face) faces_[face_count_++] = plane.triangle;
  }
}

namespace {

bool inside(const ContactShape& shape, const Vector3d& p) {
  return std::visit(
      [&](const auto& solid) {
        if constexpr (std::is_same_v<std::decay_t<decltype(solid)>, MeshPointer>) {
          return solid->contains(p);
        } else {
          return solid.contains(p);
        }
      },
      shape);
}

bool clear_of(const SurfaceMesh& mesh, const Vector3d& p) {
  ClosestPoint near;
  return !mesh.closest(p, mesh.sweep_radius(), near) && !mesh.contains(p);
}

// Lifts a surface point one clearance above the face it lies on, and above each other face that is
// then too near: at a concave crease or corner these are two or three and more.
bool lift(const SurfaceMesh& mesh, const Vector3d& foot, const ConstraintPlane& face,
          Vector3d& out) {
  ConstraintPlanes planes;
  ConstraintPlane next = face;
  while (planes.size() < ConstraintPlanes::kMax) {
    planes.add(next, foot);
    ConstraintSolution solution;
    if (!planes.solve(foot, 1e-12 * mesh.size(), solution)) return false;
    out = solution.point;
    if (clear_of(mesh, out)) return true;
    ClosestPoint near;
    if (!mesh.closest(out, 10.0 * mesh.clearance(), near)) return false;
    const Triangle& t = mesh.triangles()[near.triangle];
    next = {t.normal, t.normal.dot(t.a) + mesh.clearance(), near.triangle, true};
    if (next.normal.dot(out) >= next.level) return false;
  }
  return false;
}

// Where the SCP starts: at the device, or above the nearest surface point when that is too near or
// the device is inside.
Vector3d place_outside(const SurfaceMesh& mesh, const Vector3d& device, bool was_inside) {
  ClosestPoint nearest;
  if (!mesh.closest(device, std::numeric_limits<double>::infinity(), nearest)) return device;
  if (!was_inside && nearest.distance >= mesh.clearance()) return device;
  const Triangle& t = mesh.triangles()[nearest.triangle];
  const double side = was_inside || t.normal.dot(device - nearest.point) >= 0.0 ? 1.0 : -1.0;
  const Vector3d normal = side * t.normal;
  Vector3d lifted;
  if (lift(mesh, nearest.point,
           {normal, normal.dot(t.a) + mesh.clearance(), nearest.triangle, true}, lifted)) {
    return lifted;
  }
  // A tangle: straight out in growing steps.
  for (double reach = mesh.clearance(); reach < 2.0 * mesh.size(); reach *= 2.0) {
    lifted = nearest.point + reach * normal;
    if (clear_of(mesh, lifted)) break;
  }
  return lifted;
}

}  // namespace

bool SurfaceContactPoint::reset(const ContactShape& shape, const Vector3d& device) noexcept {
  set_free(device);
  const bool was_inside = inside(shape, device);
  if (const MeshPointer* mesh = std::get_if<MeshPointer>(&shape)) {
    point_.scp = place_outside(**mesh, device, was_inside);
  } else if (was_inside) {
    std::visit(
        [&](const auto& solid) {
          if constexpr (!std::is_same_v<std::decay_t<decltype(solid)>, MeshPointer>) {
            point_.scp = solid.nearest_outside(device);
          }
        },
        shape);
  }
  return was_inside;
}

}  // namespace reckon::haptics
