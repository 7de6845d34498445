// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/deadreckon/force/force_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace reckon::deadreckon {

namespace {

using Eigen::Vector3d;
using Kind = pdu::ForceModelKind;

Contact plane_contact(const Vector3d& point, const Vector3d& normal, const Vector3d& probe,
                      double probe_radius) {
  return {probe_radius - normal.dot(probe - point), normal, point};
}

Contact sphere_contact(const Vector3d& centre, const Vector3d& fallback, const Vector3d& probe,
                       double reach) {
  const Vector3d offset = probe - centre;
  const double distance = offset.norm();
  const Vector3d normal = distance > 0 ? Vector3d(offset / distance) : fallback;
  return {reach - distance, normal, centre};
}

Contact region_contact(const Vector3d& point, const Vector3d& normal, double radius,
                       const Vector3d& probe, double probe_radius) {
  const Contact face = plane_contact(point, normal, probe, probe_radius);
  const Vector3d offset = probe - point;
  const Vector3d lateral = offset - normal.dot(offset) * normal;
  const PegDepth peg = peg_depth(face.depth, radius + probe_radius, normal, lateral);
  return {peg.depth, peg.normal, point, peg.slope};
}

}  // namespace

// Depth is continuous everywhere, so that the spring has a potential and a sideways entry gains no
// energy. It is also concave. With a and b the depths under the face and the side, it is (a + b) /
// 2 minus a convex function of a - b. The depth from the side is a constant minus a convex function
// of the distance from the axis, which is rounded near the axis.
PegDepth peg_depth(double face, double reach, const Vector3d& normal,
                   const Vector3d& lateral) noexcept {
  const double width = std::min(kEdgeWidth, 0.5 * reach);
  const double distance = lateral.norm();
  const bool blunt = distance < width;
  const double away = blunt ? 0.5 * (distance * distance / width + width) : distance;
  const double side = reach - away;
  const double ahead = face - side;
  if (!(width > 0) || !(ahead > -width)) return {std::min(face, side), normal, 1.0};

  const double overlap = std::max(0.0, width - std::abs(ahead));
  const double share = std::min(1.0, 0.5 * (1.0 + ahead / width));  // share of the side
  const Vector3d outwards = lateral / std::max(distance, width);
  const Vector3d gradient = (1.0 - share) * normal + share * outwards;
  const double slope = gradient.norm();
  return {std::min(face, side) - 0.25 * overlap * overlap / width,
          slope > 0 ? Vector3d(gradient / slope) : normal, slope};
}

Contact contact(const ForceModel& model, const Pose& entity, const Vector3d& probe_position,
                double probe_radius) noexcept {
  const Vector3d point = entity.position + entity.orientation * model.point;
  const Vector3d normal = entity.orientation * model.normal;
  switch (model.kind) {
    case Kind::plane:
      return plane_contact(point, normal, probe_position, probe_radius);
    case Kind::sphere:
      return sphere_contact(point, normal, probe_position, model.radius + probe_radius);
    case Kind::field:
      return sphere_contact(point, normal, probe_position, model.radius);
    case Kind::spring_damper_region:
      return region_contact(point, normal, model.radius, probe_position, probe_radius);
    default:
      return {-std::numeric_limits<double>::infinity(), normal, point};
  }
}

Vector3d evaluate(const ForceModel& model, const Pose& entity, const Vector3d& probe_position,
                  const Vector3d& probe_velocity, double probe_radius) noexcept {
  const Contact touch = contact(model, entity, probe_position, probe_radius);
  if (!(touch.depth > 0)) return Vector3d::Zero();

  // The touched surface of the entity translates and rotates with the body.
  const Vector3d arm = probe_position - entity.position;
  const Vector3d spin = entity.orientation * entity.angular_velocity;
  const Vector3d surface_velocity = entity.velocity + spin.cross(arm);
  const double approach = touch.normal.dot(probe_velocity - surface_velocity);
  const double spring = touch.slope * normal_force(model.k1, model.k3, touch.depth);
  const double force = spring - model.damping * approach;
  return std::max(0.0, force) * touch.normal;
}

}  // namespace reckon::deadreckon
