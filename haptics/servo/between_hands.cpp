// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/servo/between_hands.hpp"

#include <algorithm>
#include <variant>

#include "reckon/haptics/geometry/surface_contact_point.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;

constexpr double kShare = 0.1;      // of the length inside
constexpr double kDeepest = 0.002;  // [m]
constexpr int kPlaces = 7;          // points of the segment at which the depth is evaluated

// Share of the segment before it first enters the shape.
double free_part(const ContactShape& shape, const Vector3d& from, const Vector3d& way) {
  SweepHit hit;
  return sweep_shape(shape, from, way, 0.0, hit) ? hit.t : 1.0;
}

double depth_at(const ContactShape& shape, const Vector3d& p) {
  SurfaceContactPoint point;
  return point.reset(shape, p) ? (point.scp() - p).norm() : 0.0;
}

// Both points are in the axes of the shape. A prediction error can put a hand inside the solid,
// which makes the segment seem deeper by that amount.
bool cuts(const ContactShape& shape, const Vector3d& from, const Vector3d& to, bool apart) {
  if (std::holds_alternative<HalfSpace>(shape)) return false;  // never between two points outside
  const Vector3d way = to - from;
  const double deep_from = depth_at(shape, from);
  const double begin = deep_from > 0.0 ? 0.0 : free_part(shape, from, way);
  if (!(begin < 1.0)) return false;
  const double deep_to = depth_at(shape, to);
  const double end = deep_to > 0.0 ? 1.0 : 1.0 - free_part(shape, to, -way);
  if (!(begin < end)) return false;
  const double within = (end - begin) * way.norm();
  const double beyond = kShare * within + 2.0 * std::max(deep_from, deep_to);
  const double enough = (apart ? 0.5 : 1.0) * std::min(beyond, kDeepest);
  for (int i = 1; i <= kPlaces; ++i) {
    const double at = begin + (end - begin) * i / (kPlaces + 1);
    if (depth_at(shape, from + at * way) > enough) return true;
  }
  return false;
}

}  // namespace

bool is_between_hands(const EffectPlan& plan, std::span<const BodyState> bodies,
                      const Vector3d& from, const Vector3d& to, bool apart) noexcept {
  bool found = false;
  plan.visit_near({from.cwiseMin(to), from.cwiseMax(to)}, [&](std::uint32_t index) {
    const PlannedObject& object = plan.objects()[index];
    found = found || cuts(object.shape, object.to_object(from), object.to_object(to), apart);
  });
  const Vector3d middle = 0.5 * (from + to);
  const double half = 0.5 * (to - from).norm();
  for (const BodyState& body : bodies) {
    if (found) break;
    const PlannedObject& object = plan.objects()[body.object];
    const Eigen::Matrix3d axes = body.orientation.toRotationMatrix().transpose();
    const auto local = [&](const Vector3d& p) -> Vector3d { return axes * (p - body.position); };
    if (distance_below(object.shape, local(middle)) > half) continue;
    found = cuts(object.shape, local(from), local(to), apart);
  }
  return found;
}

}  // namespace reckon::haptics
