// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/queries/way_out.hpp"

#include <cmath>

#include "reckon/haptics/queries/time_of_impact.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;

constexpr double kTolerance = 1e-6;  // [m], remaining distance of the shapes
constexpr int kDoublings = 8;        // steps from the shortest to the longest, each doubled

// Half the extent of a bounded shape along a direction.
double reach_along(const QueryShape& shape, const Placement& at, const Vector3d& direction) {
  return (at.orientation.transpose() * direction).cwiseAbs().dot(0.5 * shape.bounds().sizes());
}

Vector3d middle_of(const QueryShape& shape, const Placement& at) {
  return at.to_scene(shape.bounds().center());
}

// Moves b in doubling steps until the bounding boxes are apart. From the first free position, which
// may be in a hole, b moves back as far as it can.
double exit_along(const QueryShape& a, const Placement& a_at, const QueryShape& b,
                  const Placement& b_at, const Vector3d& direction) {
  const double apart = reach_along(a, a_at, direction) + reach_along(b, b_at, direction) -
                       direction.dot(middle_of(b, b_at) - middle_of(a, a_at));
  const double farthest = apart + 4.0 * kTolerance;
  double start = farthest * std::ldexp(1.0, -kDoublings);
  Placement moved = b_at;
  for (; start < farthest; start *= 2.0) {
    moved.position = b_at.position + start * direction;
    if (measure_pair(a, a_at, b, moved).overlap == Overlap::no) break;
  }
  moved.position = b_at.position + start * direction;
  const ImpactTime found = time_of_impact(a, {a_at, Vector3d::Zero(), Vector3d::Zero()}, b,
                                          {moved, -direction, Vector3d::Zero()}, start, kTolerance);
  return start - found.time;
}

}  // namespace

WayOut way_out(const QueryShape& a, const Placement& a_at, const QueryShape& b,
               const Placement& b_at) noexcept {
  const PairMeasure m = measure_pair(a, a_at, b, b_at);
  if (m.overlap == Overlap::no) return {0.0, m.direction};
  WayOut best{m.depth.most, m.direction};
  if (m.depth.least == m.depth.most || !a.is_bounded() || !b.is_bounded()) return best;
  const auto offer = [&](const Vector3d& direction) {
    const double way = exit_along(a, a_at, b, b_at, direction);
    if (way < best.way) best = {way, direction};
  };
  offer(m.direction);
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (const double sign : {1.0, -1.0}) {
      offer(sign * Vector3d::Unit(i));
      offer(sign * a_at.orientation.col(i));
      offer(sign * b_at.orientation.col(i));
    }
  }
  return best;
}

}  // namespace reckon::haptics
