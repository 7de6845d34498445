// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/geometry/surface_contact_point.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "reckon/haptics/geometry/constraint_planes.hpp"
#include "reckon/haptics/geometry/contact_walk.hpp"

namespace reckon::haptics {

namespace {

using Eigen::Vector3d;
using MeshPointer = std::shared_ptr<const SurfaceMesh>;
using ImplicitPointer = std::shared_ptr<const ImplicitSolid>;

template <class Held>
inline constexpr bool kIsShared =
    std::is_same_v<Held, MeshPointer> || std::is_same_v<Held, ImplicitPointer>;

// Greatest height above a face that still counts as held by it, in clearances.
constexpr double kHeldHeight = 1.01;

auto visit_solid(const ContactShape& shape, auto&& function) {
  return std::visit(
      [&](const auto& solid) {
        if constexpr (kIsShared<std::decay_t<decltype(solid)>>) {
          return function(*solid);
        } else {
          return function(solid);
        }
      },
      shape);
}

template <class Solid>
bool within_solid(const Solid& solid, const Vector3d& p, double radius) {
  if constexpr (std::is_same_v<Solid, SurfaceMesh>) {
    return false;
  } else {
    return solid.contains(p, radius);
  }
}

// One object as the obstacle of a ContactWalk.
template <class Solid>
struct OneObstacle {
  const Solid& solid;
  double radius;
  FrictionCone* friction;
  NearTriangles& near;

  [[nodiscard]] bool sweep(const Vector3d& p, const Vector3d& step, SweepHit& hit) const noexcept {
    if constexpr (std::is_same_v<Solid, SurfaceMesh>) {
      return solid.sweep(p, step, radius, near, hit);
    } else {
      return solid.sweep(p, step, radius, hit);
    }
  }
  [[nodiscard]] bool within(const Vector3d& p) const noexcept {
    return within_solid(solid, p, radius);
  }
  [[nodiscard]] double clearance() const noexcept { return solid.clearance(); }
  [[nodiscard]] double size() const noexcept { return solid.size(); }

  [[nodiscard]] bool holds(const ConstraintPlane& plane, const Vector3d& p) const noexcept {
    if constexpr (std::is_same_v<Solid, SurfaceMesh>) {
      if (!plane.on_face || !solid.over(plane.triangle, p)) return false;
      const TriangleView t = solid.triangles().view(plane.triangle);
      return std::abs(t.normal.dot(p - t.a)) - radius <= kHeldHeight * solid.clearance();
    }
    return false;
  }

  [[nodiscard]] double held(double lateral, const ConstraintPlanes& /*planes*/,
                            const ConstraintSolution& solution, bool sliding) const noexcept {
    return friction == nullptr ? 0.0 : friction->held(lateral, solution.load, sliding);
  }
};

// A face holds p without a search if p is within the clearance above it and the device is on its
// other side.
void add_held(const SurfaceMesh& mesh, std::uint32_t triangle, double radius,
              ContactWalk<OneObstacle<SurfaceMesh>>& walk) {
  const TriangleView t = mesh.triangles().view(triangle);
  const Vector3d& p = walk.p;
  const double above = t.normal.dot(p - t.a);
  const double side = above < 0.0 ? -1.0 : 1.0;
  if (std::abs(above) - radius > kHeldHeight * mesh.clearance()) return;
  if (side * t.normal.dot(walk.device - p) >= 0.0 || !mesh.over(triangle, p)) return;
  const double spare = std::max(0.0, std::abs(above) - (radius + mesh.clearance()));
  walk.planes.add({side * t.normal, side * t.normal.dot(p) - spare, triangle, 0, true}, p);
}

}  // namespace

bool sweep_shape(const ContactShape& shape, const Vector3d& origin, const Vector3d& step,
                 double radius, SweepHit& hit) noexcept {
  return visit_solid(shape,
                     [&](const auto& solid) { return solid.sweep(origin, step, radius, hit); });
}

bool is_within(const ContactShape& shape, const Vector3d& p, double radius) noexcept {
  return visit_solid(shape, [&](const auto& solid) { return within_solid(solid, p, radius); });
}

double clearance_of(const ContactShape& shape) noexcept {
  return visit_solid(shape, [](const auto& solid) { return solid.clearance(); });
}

double distance_below(const ContactShape& shape, const Vector3d& p) noexcept {
  return visit_solid(shape, [&](const auto& solid) { return solid.distance_below(p); });
}

std::optional<Vector3d> nearest_inside(const ContactShape& shape, const Vector3d& p) noexcept {
  return visit_solid(shape, [&](const auto& solid) -> std::optional<Vector3d> {
    if constexpr (requires { solid.nearest_inside(p); }) return solid.nearest_inside(p);
    return std::nullopt;
  });
}

void SurfaceContactPoint::set_free(const Vector3d& device) noexcept {
  point_ = {device, Vector3d::Zero(), false};
  face_count_ = 0;
}

void SurfaceContactPoint::update(const ContactShape& shape, const Vector3d& device,
                                 FrictionCone* friction) noexcept {
  std::visit(
      [&](const auto& solid) {
        using Solid = std::decay_t<decltype(solid)>;
        if constexpr (kIsShared<Solid>) {
          walk(*solid, device, friction);
        } else if constexpr (std::is_same_v<Solid, Block>) {
          if (radius_ > 0.0) {
            walk(solid, device, friction);
          } else {
            point_ = solid.settle(point_.scp, device, friction);
          }
        } else {
          point_ = solid.settle(point_.scp, device, friction, radius_);
        }
      },
      shape);
}

template <class Solid>
void SurfaceContactPoint::walk(const Solid& solid, const Vector3d& device,
                               FrictionCone* friction) noexcept {
  const OneObstacle<Solid> obstacle{solid, radius_, friction, near_};
  ContactWalk<OneObstacle<Solid>> walk{obstacle, device, point_.scp,
                                       friction != nullptr && friction->sliding()};
  if constexpr (std::is_same_v<Solid, SurfaceMesh>) {
    for (std::size_t i = 0; i < face_count_; ++i) add_held(solid, faces_[i], radius_, walk);
  }
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
  double most = 0.0;
  for (std::size_t i = 0; i < walk.solution.active_count; ++i) {
    const ConstraintPlane& plane = walk.planes[walk.solution.active[i]];
    if (walk.solution.loads[i] > most) {
      most = walk.solution.loads[i];
      triangle_ = plane.triangle;
    }
    if (plane.on_face) faces_[face_count_++] = plane.triangle;
  }
}

namespace {

bool inside(const ContactShape& shape, const Vector3d& p) {
  return visit_solid(shape, [&](const auto& solid) { return solid.contains(p); });
}

bool clear_of(const SurfaceMesh& mesh, const Vector3d& p, double radius) {
  ClosestPoint near;
  return !mesh.closest(p, radius + mesh.sweep_radius(), near) && !mesh.contains(p);
}

// Lifts a surface point by `height` above its face, and above each other face that is then too
// near: several at a concave crease or corner.
bool lift(const SurfaceMesh& mesh, const Vector3d& foot, double radius, const ConstraintPlane& face,
          Vector3d& out) {
  const double height = radius + mesh.clearance();
  ConstraintPlanes planes;
  ConstraintPlane next = face;
  while (planes.size() < ConstraintPlanes::kMax) {
    planes.add(next, foot);
    ConstraintSolution solution;
    if (!planes.solve(foot, 1e-12 * mesh.size(), solution)) return false;
    out = solution.point;
    if (clear_of(mesh, out, radius)) return true;
    ClosestPoint near;
    if (!mesh.closest(out, radius + 10.0 * mesh.clearance(), near)) return false;
    const TriangleView t = mesh.triangles().view(near.triangle);
    next = {t.normal, t.normal.dot(t.a) + height, near.triangle, 0, true};
    if (next.normal.dot(out) >= next.level) return false;
  }
  return false;
}

// Start of the SCP: the device, or a place above the nearest surface point if the device is too
// near or inside.
Vector3d place_outside(const SurfaceMesh& mesh, const Vector3d& device, double radius,
                       bool was_inside) {
  const double height = radius + mesh.clearance();
  ClosestPoint nearest;
  if (!mesh.closest(device, std::numeric_limits<double>::infinity(), nearest)) return device;
  if (!was_inside && nearest.distance >= height) return device;
  const TriangleView t = mesh.triangles().view(nearest.triangle);
  const double side = was_inside || t.normal.dot(device - nearest.point) >= 0.0 ? 1.0 : -1.0;
  const Vector3d normal = side * t.normal;
  Vector3d lifted;
  if (lift(mesh, nearest.point, radius,
           {normal, normal.dot(t.a) + height, nearest.triangle, 0, true}, lifted)) {
    return lifted;
  }
  // If faces are tangled: straight out in growing steps.
  for (double reach = height; reach < 2.0 * (mesh.size() + radius); reach *= 2.0) {
    lifted = nearest.point + reach * normal;
    if (clear_of(mesh, lifted, radius)) break;
  }
  return lifted;
}

}  // namespace

bool SurfaceContactPoint::reset(const ContactShape& shape, const Vector3d& device) noexcept {
  set_free(device);
  near_.clear();
  const bool was_inside = inside(shape, device);
  visit_solid(shape, [&](const auto& solid) {
    if constexpr (std::is_same_v<std::decay_t<decltype(solid)>, SurfaceMesh>) {
      point_.scp = place_outside(solid, device, radius_, was_inside);
    } else if (solid.contains(device, radius_)) {
      point_.scp = solid.nearest_outside(device, radius_);
    }
  });
  return was_inside;
}

bool SurfaceContactPoint::overlaps(const ContactShape& shape, const Vector3d& p) const noexcept {
  return visit_solid(shape, [&](const auto& solid) {
    using Solid = std::decay_t<decltype(solid)>;
    if constexpr (std::is_same_v<Solid, SurfaceMesh>) {
      ClosestPoint near;
      return solid.closest(p, radius_ + 0.5 * solid.sweep_radius(), near) || solid.contains(p);
    } else {
      // Inside a block a sweep would meet its faces from behind; an implicit solid is never met
      // from inside.
      constexpr double kNearest =
          std::is_same_v<Solid, Block> || std::is_same_v<Solid, ImplicitSolid> ? 0.5 : -0.25;
      return solid.contains(p, radius_ + kNearest * solid.clearance());
    }
  });
}

}  // namespace reckon::haptics
