// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/impact.hpp"

namespace reckon::peer {
namespace {

// Slower contacts are no collisions, IEEE 1278.1 (COLLISION_ELASTIC threshold).
constexpr double kCollisionSpeed = 0.1;  // [m/s]

pdu::Vector3Float to_floats(const Eigen::Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

}  // namespace

std::optional<pdu::CollisionElastic> impact_of(const haptics::ServoSnapshot& servo, double radius,
                                               const haptics::ContactAccount& contact,
                                               const RemoteEntity& row,
                                               const deadreckon::LocalFrame& frame,
                                               std::chrono::nanoseconds now) noexcept {
  const deadreckon::Pose pose = row.predicted(now);
  const Eigen::Vector3d normal = contact.ungated_force.normalized();
  const Eigen::Vector3d velocity = servo.device_velocity - pose.velocity;
  if (-velocity.dot(normal) < kCollisionSpeed) return std::nullopt;

  const Eigen::Vector3d place = servo.device - radius * normal;
  pdu::CollisionElastic impact;
  impact.colliding_entity_id = row.id;
  impact.contact_velocity = to_floats(frame.world_from_scene_vector(servo.device_velocity));
  impact.location_of_impact = to_floats(pose.orientation.conjugate() * (place - pose.position));
  impact.unit_surface_normal = to_floats(frame.world_from_scene_vector(normal));
  impact.coefficient_of_restitution = static_cast<float>(row.model.restitution);
  return impact;
}

}  // namespace reckon::peer
