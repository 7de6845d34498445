// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/queries/solid_gap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "reckon/haptics/queries/least_value.hpp"

namespace reckon::haptics {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

constexpr double kBoundsApart = 1e-10;       // of the size, difference of the bounds
constexpr double kOnSurface = 1e-12;         // of the size, tolerance of a walk to the surface
constexpr double kFunctionRounding = 1e-14;  // of the size and the distance, of a signed function
constexpr double kLeastSteepness = 0.1;      // of a gradient squared, within rounded edges
constexpr int kMostFeet = 48;
constexpr int kMostTurns = 32;    // alternations between the shapes, towards the nearest pair
constexpr double kFarAway = 1e7;  // [sizes]: from this distance a ball is as good as a plane
constexpr double kNoBound = std::numeric_limits<double>::infinity();

// Walks down the gradient to a point of the solid. @return false if none was reached
bool walk_to(const ImplicitSolid& solid, Vector3d& p) {
  for (int i = 0; i < kMostFeet; ++i) {
    const SignedSample here = solid.sample(p);
    if (here.value <= kOnSurface * solid.size()) return true;
    p -= here.value / std::max(here.gradient.squaredNorm(), kLeastSteepness) * here.gradient;
  }
  return false;
}

// Improves the nearest points by alternating projections; `other(p)` is the nearest point of the
// other shape.
void come_nearer(const ImplicitSolid& solid, const auto& other, SolidGap& gap) {
  Vector3d on_b = gap.on_b;
  for (int i = 0; i < kMostTurns; ++i) {
    Vector3d on_a = on_b;
    if (!walk_to(solid, on_a)) return;
    const double before = gap.most;
    on_b = other(on_a);
    const double distance = (on_b - on_a).norm();
    if (!(distance < gap.most)) return;
    gap.most = distance;
    gap.on_a = on_a;
    gap.on_b = on_b;
    if (before - distance < 1e-12 * distance) return;
  }
}

// Converts bounds of a least value to bounds of a distance.
SolidGap gap_of(const LeastValue& value, double size) {
  const double rounding = kFunctionRounding * (size + std::abs(value.most));
  SolidGap gap{value.least - rounding, kNoBound, value.at, value.at};
  if (value.most < -rounding) gap.most = value.most + rounding;
  return gap;
}

/// A part of a mesh's surface: a box of its tree, a run of triangles, or a piece of one.
struct MeshPiece {
  const SurfaceMesh* mesh = nullptr;
  std::array<Vector3d, 3> corners{};  // of a triangle, or the middle and half edges of a box
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  bool is_box = true;

  static MeshPiece of(const SurfaceMesh& mesh, const BoundingVolumeTree::Branch& branch) {
    MeshPiece piece;
    piece.mesh = &mesh;
    piece.corners[0] = branch.box.center();
    piece.corners[1] = 0.5 * branch.box.sizes();
    piece.first = branch.first;
    piece.count = branch.count;
    return piece;
  }
  [[nodiscard]] bool on_set() const noexcept { return !is_box; }
  [[nodiscard]] Vector3d middle() const noexcept {
    return is_box ? corners[0] : Vector3d((corners[0] + corners[1] + corners[2]) / 3.0);
  }
  [[nodiscard]] double radius() const noexcept {
    if (is_box) return corners[1].norm();
    const Vector3d m = middle();
    return std::sqrt(std::max({(corners[0] - m).squaredNorm(), (corners[1] - m).squaredNorm(),
                               (corners[2] - m).squaredNorm()}));
  }
  [[nodiscard]] Vector3d lowest(const Vector3d& slope) const noexcept {
    if (is_box) return BoxPiece{corners[0], corners[1]}.lowest(slope);
    const std::array<double, 3> heights{slope.dot(corners[0]), slope.dot(corners[1]),
                                        slope.dot(corners[2])};
    return corners[static_cast<std::size_t>(std::min_element(heights.begin(), heights.end()) -
                                            heights.begin())];
  }
  void split(auto&& take) const noexcept {
    if (!is_box) return halve(take);
    if (count == 0) {
      mesh->tree().visit_children(
          first, [&](const BoundingVolumeTree::Branch& branch) { take(of(*mesh, branch)); });
      return;
    }
    for (std::uint32_t i = first; i < first + count; ++i) {
      const Triangle& t = mesh->triangles()[i];
      MeshPiece part = *this;
      part.is_box = false;
      part.corners = {t.a, t.b, t.c};
      take(part);
    }
  }

 private:
  // Splits it at the middle of its longest side.
  void halve(auto&& take) const noexcept {
    std::size_t longest = 0;
    double most = -1.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double length = (corners[(i + 1) % 3] - corners[i]).squaredNorm();
      if (length <= most) continue;
      most = length;
      longest = i;
    }
    const std::size_t next = (longest + 1) % 3;
    const Vector3d between = 0.5 * (corners[longest] + corners[next]);
    for (const std::size_t moved : {longest, next}) {
      MeshPiece part = *this;
      part.corners[moved] = between;
      take(part);
    }
  }
};

}  // namespace

SolidGap solid_box_gap(const ImplicitSolid& solid, const OrientedBox& box) noexcept {
  const auto in_solid = [&](const Vector3d& p) { return Vector3d(box.centre + box.axes * p); };
  const auto field = [&](const Vector3d& p) {
    SignedSample sample = solid.sample(in_solid(p));
    sample.gradient = box.axes.transpose() * sample.gradient;
    return sample;
  };
  const double size = solid.size() + box.half.norm();
  const LeastValue value = least_value(BoxPiece{Vector3d::Zero(), box.half}, field,
                                       solid.function().convex(), kBoundsApart * size);
  SolidGap gap = gap_of(value, size);
  gap.on_a = gap.on_b = in_solid(value.at);
  if (gap.most < 0.0) return gap;
  come_nearer(
      solid,
      [&](const Vector3d& p) {
        const Vector3d own = box.axes.transpose() * (p - box.centre);
        return in_solid(own.cwiseMax(-box.half).cwiseMin(box.half));
      },
      gap);
  return gap;
}

// The mean of both functions is below the greater one, and smooth where they are equal. At the
// middle between the nearest points both are equal with opposite gradients, so its tangents are
// best there.
//
// For closest points a and b at distance d, both functions are at most d/2 at their middle, which
// is in the mean of both bounding boxes, as is any common point. If one solid is unbounded, both
// functions are at most d at the closest point of the other.
SolidGap solid_solid_gap(const ImplicitSolid& a, const ImplicitSolid& b,
                         const Placement& b_at) noexcept {
  const bool bounded_a = a.bounds().sizes().allFinite();
  const bool bounded_b = b.bounds().sizes().allFinite();
  SolidGap gap{-kNoBound, kNoBound, Vector3d::Zero(), Vector3d::Zero()};
  if (!bounded_a && !bounded_b) return gap;
  BoxPiece room_a, room_b;
  if (bounded_a) room_a = {a.bounds().center(), 0.5 * a.bounds().sizes()};
  if (bounded_b)
    room_b = {b_at.to_scene(b.bounds().center()),
              b_at.orientation.cwiseAbs() * (0.5 * b.bounds().sizes())};
  BoxPiece room = bounded_a ? room_a : room_b;
  if (bounded_a && bounded_b)
    room = {0.5 * (room_a.centre + room_b.centre), 0.5 * (room_a.half + room_b.half)};
  const double share = bounded_a && bounded_b ? 2.0 : 1.0;

  const auto field = [&](const Vector3d& p) {
    const SignedSample one = a.sample(p);
    const SignedSample two = b.sample(b_at.to_shape(p));
    const Vector3d gradient = one.gradient + b_at.orientation * two.gradient;
    return FieldSample(std::max(one.value, two.value),
                       {0.5 * (one.value + two.value), 0.5 * gradient});
  };
  const double size = a.size() + b.size() + room.centre.norm();
  const bool convex = a.function().convex() && b.function().convex();
  LeastValue value = least_value(room, field, convex, kBoundsApart * size);
  if (value.least > 0.0) value.least *= share;
  if (value.most < 0.0) value.most *= 2.0;  // a ball of that radius is in both solids
  gap = gap_of(value, size);
  if (gap.most < 0.0) return gap;
  Vector3d on_b = b_at.to_shape(value.at);
  if (!walk_to(b, on_b)) return gap;
  gap.on_b = b_at.to_scene(on_b);
  come_nearer(
      a,
      [&](const Vector3d& p) {
        Vector3d foot = b_at.to_shape(p);
        return walk_to(b, foot) ? b_at.to_scene(foot) : gap.on_b;
      },
      gap);
  return gap;
}

SolidGap solid_mesh_gap(const ImplicitSolid& solid, const SurfaceMesh& mesh,
                        const Placement& mesh_at) noexcept {
  const auto field = [&](const Vector3d& p) {
    SignedSample sample = solid.sample(mesh_at.to_scene(p));
    sample.gradient = mesh_at.orientation.transpose() * sample.gradient;
    return sample;
  };
  const double size = solid.size() + mesh.size();
  const LeastValue value = least_value(MeshPiece::of(mesh, mesh.tree().root()), field,
                                       solid.function().convex(), kBoundsApart * size);
  SolidGap gap = gap_of(value, size);
  gap.on_a = gap.on_b = mesh_at.to_scene(value.at);
  if (gap.most < 0.0) return gap;
  come_nearer(
      solid,
      [&](const Vector3d& p) {
        ClosestPoint closest;
        mesh.closest_from(mesh_at.to_shape(p), 0, closest);
        return mesh_at.to_scene(closest.point);
      },
      gap);
  return gap;
}

// Each point of the solid is at least f away from a point far below it. So its height h above that
// point fulfils h^2 + r^2 >= f^2, with its distance r from the vertical axis.
SolidGap lowest_of_solid(const ImplicitSolid& solid, const Vector3d& up) noexcept {
  SolidGap lowest{-kNoBound, kNoBound, Vector3d::Zero(), Vector3d::Zero()};
  const AlignedBox3d& bounds = solid.bounds();
  if (!bounds.sizes().allFinite()) return lowest;
  const Vector3d centre = bounds.center();
  const Vector3d half = 0.5 * bounds.sizes();
  const double away = kFarAway * half.norm();
  const Vector3d far = centre - away * up;
  const double free = solid.sample(far).value - 1e-15 * away;
  const double along = std::sqrt(std::max(0.0, free * free - half.squaredNorm())) - away;
  lowest.least = up.dot(centre) + std::max(along, -up.cwiseAbs().dot(half));
  Vector3d foot = far + free * solid.sample(far).gradient;
  if (!walk_to(solid, foot)) return lowest;
  lowest.most = up.dot(foot) + kOnSurface * solid.size();
  lowest.on_a = foot;
  return lowest;
}

}  // namespace reckon::haptics
