// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/queries/pair_query.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <type_traits>
#include <utility>
#include <variant>

#include "reckon/haptics/queries/box_axes.hpp"
#include "reckon/haptics/queries/mesh_gap.hpp"
#include "reckon/haptics/queries/solid_gap.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;
using Mesh = std::shared_ptr<const SurfaceMesh>;
using Solid = std::shared_ptr<const ImplicitSolid>;

// Index in QueryShape::Form.
template <class S>
constexpr int kRank = std::is_same_v<S, BelowPlane>   ? 0
                      : std::is_same_v<S, RoundedBox> ? 1
                      : std::is_same_v<S, Mesh>       ? 2
                                                      : 3;

constexpr double kInfinite = std::numeric_limits<double>::infinity();
// Share of the sizes below which the direction between nearest points is noise.
constexpr double kNoDirection = 1e-12;
constexpr double kSure = 1e-12;  // of the size: margin of a candidate depth

// All functions below use the axes of the first shape; `at` is the placement of the second.

OrientedBox core_of(const RoundedBox& box) {
  return {Vector3d::Zero(), Eigen::Matrix3d::Identity(), box.half};
}

OrientedBox core_of(const RoundedBox& box, const Placement& at) {
  return {at.position, at.orientation, box.half};
}

OrientedBox around(const Eigen::AlignedBox3d& bounds, const Placement& at) {
  return {at.to_scene(bounds.center()), at.orientation, 0.5 * bounds.sizes()};
}

// Measure of an exact gap; below 0: overlap.
PairMeasure exact(double gap, const Vector3d& direction) {
  PairMeasure m;
  m.overlap = gap < 0.0 ? Overlap::yes : Overlap::no;
  m.distance = {std::max(0.0, gap), std::max(0.0, gap)};
  m.depth = {std::max(0.0, -gap), std::max(0.0, -gap)};
  m.direction = direction;
  return m;
}

// Sets the nearest points: the ones of the cores, moved onto the balls around them.
void set_points(PairMeasure& m, const HullGap& gap, double radius_a, double radius_b) {
  m.on_a = gap.on_a + radius_a * m.direction;
  m.on_b = gap.on_b - radius_b * m.direction;
}

PairMeasure measure(const RoundedBox& a, const RoundedBox& b, const Placement& at,
                    PairMemory& memory) {
  const OrientedBox core_a = core_of(a);
  const OrientedBox core_b = core_of(b, at);
  const double radius = a.radius + b.radius;
  const AxisGap apart = widest_gap(core_a, core_b);
  if (!(apart.gap > 0.0)) {
    const PairMeasure m = exact(apart.gap - radius, apart.direction);
    if (m.overlap == Overlap::yes) return m;
  }
  const HullGap gap = hull_gap(Hull::of_box(core_a.centre, core_a.axes, core_a.half),
                               Hull::of_box(core_b.centre, core_b.axes, core_b.half), memory.start);
  const double size = core_a.half.sum() + core_b.half.sum();
  const bool has_direction = gap.distance > kNoDirection * size;
  const double distance = has_direction ? gap.distance : std::max(0.0, apart.gap);
  PairMeasure m =
      exact(distance - radius,
            has_direction ? Vector3d((gap.on_b - gap.on_a) / gap.distance) : apart.direction);
  set_points(m, gap, a.radius, b.radius);
  return m;
}

PairMeasure measure(const RoundedBox& a, const BelowPlane& b, const Placement& at,
                    PairMemory& /*memory*/) {
  const Vector3d normal = at.orientation * b.normal;
  Vector3d lowest = Vector3d::Zero();
  for (Eigen::Index i = 0; i < 3; ++i) {
    if (normal[i] != 0.0) lowest[i] = -std::copysign(a.half[i], normal[i]);
  }
  lowest -= a.radius * normal;
  const double height = normal.dot(lowest - at.position);
  PairMeasure m = exact(height, -normal);
  m.on_a = lowest;
  m.on_b = lowest - height * normal;
  return m;
}

PairMeasure measure(const BelowPlane& a, const BelowPlane& b, const Placement& at,
                    PairMemory& /*memory*/) {
  const Vector3d other = at.orientation * b.normal;
  PairMeasure m;
  if (a.normal == -other) {
    const double height = a.normal.dot(at.position);
    m = exact(height, a.normal);
    m.on_b = height * a.normal;
    return m;
  }
  m.overlap = Overlap::yes;
  m.distance = {0.0, 0.0};
  m.depth = {kInfinite, kInfinite};
  m.direction = a.normal;
  return m;
}

PairMeasure measure(const Mesh& a, const BelowPlane& b, const Placement& at,
                    PairMemory& /*memory*/) {
  const Vector3d normal = at.orientation * b.normal;
  const Vector3d lowest = lowest_corner(*a, normal);
  const double height = normal.dot(lowest - at.position);
  PairMeasure m = exact(height, -normal);
  m.on_a = lowest;
  m.on_b = lowest - height * normal;
  return m;
}

PairMeasure measure(const Solid& a, const BelowPlane& b, const Placement& at,
                    PairMemory& /*memory*/) {
  const Vector3d normal = at.orientation * b.normal;
  SolidGap lowest = lowest_of_solid(*a, normal);
  const double level = normal.dot(at.position);
  lowest.least -= level;
  lowest.most -= level;
  PairMeasure m;
  if (lowest.least >= 0.0) m.overlap = Overlap::no;
  if (lowest.most < 0.0) m.overlap = Overlap::yes;
  m.distance = {std::max(0.0, lowest.least), std::max(0.0, lowest.most)};
  m.depth = {std::max(0.0, -lowest.most), std::max(0.0, -lowest.least)};
  m.direction = -normal;
  m.on_a = lowest.on_a;
  m.on_b = lowest.on_a - lowest.most * normal;
  return m;
}

// Measure of a surface, with a ball of `radius` around the second shape.
PairMeasure of_surface(const HullGap& gap, double radius, bool within) {
  if (gap.distance > 0.0 && !within) {
    PairMeasure m = exact(gap.distance - radius, (gap.on_b - gap.on_a) / gap.distance);
    set_points(m, gap, 0.0, radius);
    if (m.overlap == Overlap::yes) m.depth.most = kInfinite;
    return m;
  }
  PairMeasure m = exact(-gap.distance - radius, Vector3d::UnitX());
  if (within) m.direction = (gap.on_a - gap.on_b) / gap.distance;
  m.overlap = Overlap::yes;  // at least touching
  m.depth.most = kInfinite;
  return m;
}

PairMeasure measure(const Mesh& a, const RoundedBox& b, const Placement& at, PairMemory& memory) {
  const HullGap gap = mesh_box_gap(*a, core_of(b, at), memory.triangle_a);
  return of_surface(gap, b.radius, gap.distance > 0.0 && a->contains(at.position));
}

PairMeasure measure(const Mesh& a, const Mesh& b, const Placement& at, PairMemory& memory) {
  const HullGap gap = mesh_mesh_gap(*a, *b, at, memory.triangle_a, memory.triangle_b);
  const bool within = gap.distance > 0.0 && (a->contains(at.to_scene(b->triangles()[0].a)) ||
                                             b->contains(at.to_shape(a->triangles()[0].a)));
  return of_surface(gap, 0.0, within);
}

// Measure from bounds of a distance, with a ball of `radius` around the second shape.
PairMeasure of_solid(const ImplicitSolid& solid, const SolidGap& gap, double radius) {
  PairMeasure m;
  const double least = gap.least - radius;
  const double most = gap.most - radius;
  if (least >= 0.0) m.overlap = Overlap::no;
  if (most < 0.0) m.overlap = Overlap::yes;
  m.distance = {std::max(0.0, least), std::max(0.0, most)};
  m.depth = {std::max(0.0, -most), m.overlap == Overlap::no ? 0.0 : kInfinite};
  const Vector3d way =
      gap.most > 0.0 ? Vector3d(gap.on_b - gap.on_a) : solid.sample(gap.on_a).gradient;
  if (gap.most < kInfinite && way.squaredNorm() > 0.0) m.direction = way.normalized();
  m.on_a = gap.on_a;
  m.on_b = gap.on_b - radius * m.direction;
  return m;
}

PairMeasure measure(const Solid& a, const RoundedBox& b, const Placement& at,
                    PairMemory& /*memory*/) {
  return of_solid(*a, solid_box_gap(*a, core_of(b, at)), b.radius);
}

PairMeasure measure(const Solid& a, const Solid& b, const Placement& at, PairMemory& /*memory*/) {
  return of_solid(*a, solid_solid_gap(*a, *b, at), 0.0);
}

PairMeasure measure(const Solid& a, const Mesh& b, const Placement& at, PairMemory& /*memory*/) {
  const SolidGap gap = solid_mesh_gap(*a, *b, at);
  PairMeasure m = of_solid(*a, gap, 0.0);
  if (m.overlap != Overlap::no) return m;
  // The solid does not touch the surface, so it is entirely inside the mesh or outside.
  if (gap.most == kInfinite) {
    m.overlap = Overlap::unknown;
  } else if (b->contains(at.to_shape(gap.on_a))) {
    m.overlap = Overlap::yes;
    m.distance = {0.0, 0.0};
    m.depth.least = gap.least;
  } else {
    return m;
  }
  m.depth.most = kInfinite;
  return m;
}

PairMeasure measure_forms(const QueryShape& a, const QueryShape& b, const Placement& at,
                          PairMemory& memory) {
  return std::visit(
      [&](const auto& one, const auto& other) {
        using A = std::decay_t<decltype(one)>;
        using B = std::decay_t<decltype(other)>;
        // The order of comes_before() excludes other pairs.
        if constexpr (kRank<A> >= kRank<B>) {
          return measure(one, other, at, memory);
        } else {
          return PairMeasure{};
        }
      },
      a.form(), b.form());
}

// Tries a translation by the least depth towards the nearest surface: if it separates the shapes,
// it is the depth. Otherwise takes an axis of the bounding boxes, which surely separates them.
void bound_depth(const QueryShape& a, const QueryShape& b, const Placement& at, PairMeasure& m) {
  const double size = a.bounds().sizes().norm() + b.bounds().sizes().norm();
  if (m.depth.least > 0.0) {
    const double way = m.depth.least + kSure * size;
    PairMemory memory;
    const Placement moved{at.position + way * m.direction, at.orientation};
    if (measure_forms(a, b, moved, memory).overlap == Overlap::no) {
      m.depth.most = way;
      return;
    }
  }
  const AxisGap apart = widest_gap(around(a.bounds(), Placement{}), around(b.bounds(), at));
  m.direction = apart.direction;
  m.depth.most = std::max(m.depth.least, -apart.gap);
  if (!(apart.gap > 0.0)) return;
  m.overlap = Overlap::no;
  m.distance.least = std::max(m.distance.least, apart.gap);
  m.depth = {0.0, 0.0};
}

// An order that is independent of the order of the arguments: by kind, by extents, by placement.
bool comes_before(const QueryShape& a, const Placement& a_at, const QueryShape& b,
                  const Placement& b_at) {
  if (a.form().index() != b.form().index()) return a.form().index() > b.form().index();
  const auto compare = [](const double* one, const double* other, int count) {
    for (int i = 0; i < count; ++i) {
      if (one[i] != other[i]) return one[i] < other[i] ? -1 : 1;
    }
    return 0;
  };
  int order = compare(a.bounds().max().data(), b.bounds().max().data(), 3);
  if (order == 0) order = compare(a.bounds().min().data(), b.bounds().min().data(), 3);
  const double reach_a = a.turning_reach(), reach_b = b.turning_reach();
  if (order == 0) order = compare(&reach_a, &reach_b, 1);
  if (order == 0) order = compare(a_at.position.data(), b_at.position.data(), 3);
  if (order == 0) order = compare(a_at.orientation.data(), b_at.orientation.data(), 9);
  return order <= 0;
}

// Measures in the axes of the first shape, so the error scales with the distance of the shapes.
PairMeasure measure_in_order(const QueryShape& a, const Placement& a_at, const QueryShape& b,
                             const Placement& b_at, PairMemory& memory) {
  const Placement at{a_at.to_shape(b_at.position), a_at.orientation.transpose() * b_at.orientation};
  PairMeasure m = measure_forms(a, b, at, memory);
  if (m.depth.most == kInfinite && a.is_bounded() && b.is_bounded()) bound_depth(a, b, at, m);
  m.on_a = a_at.to_scene(m.on_a);
  m.on_b = a_at.to_scene(m.on_b);
  m.direction = a_at.orientation * m.direction;
  return m;
}

}  // namespace

PairMeasure measure_pair(const QueryShape& a, const Placement& a_at, const QueryShape& b,
                         const Placement& b_at, PairMemory& memory) noexcept {
  if (comes_before(a, a_at, b, b_at)) return measure_in_order(a, a_at, b, b_at, memory);
  PairMeasure m = measure_in_order(b, b_at, a, a_at, memory);
  std::swap(m.on_a, m.on_b);
  m.direction = -m.direction;
  return m;
}

PairMeasure measure_pair(const QueryShape& a, const Placement& a_at, const QueryShape& b,
                         const Placement& b_at) noexcept {
  PairMemory memory;
  return measure_pair(a, a_at, b, b_at, memory);
}

}  // namespace reckon::haptics
