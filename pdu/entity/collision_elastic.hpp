// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Collision-Elastic PDU (type 66, IEEE 1278.1-2012 7.2.4): a collision with all data for the
// rebound.
#pragma once

#include <cstdint>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::pdu {

/// The six independent entries of the symmetric matrix from the standard's collision computation.
struct CollisionIntermediateResult {
  float xx = 0.0F;
  float xy = 0.0F;
  float xz = 0.0F;
  float yy = 0.0F;
  float yz = 0.0F;
  float zz = 0.0F;

  friend constexpr bool operator==(const CollisionIntermediateResult&,
                                   const CollisionIntermediateResult&) = default;
};

struct CollisionElastic {
  static constexpr PduType kPduType = PduType::collision_elastic;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::entity_information_interaction;

  PduHeader header = header_of<CollisionElastic>();
  EntityId issuing_entity_id;
  EntityId colliding_entity_id;
  EventId event_id;
  std::uint16_t padding = 0;
  Vector3Float contact_velocity;  ///< of the contact point of the issuing entity, world axes [m/s]
  float mass = 0.0F;              ///< of the issuing entity [kg]
  Vector3Float location_of_impact;  ///< body axes of the other entity [m]
  CollisionIntermediateResult intermediate_result;
  Vector3Float unit_surface_normal;  ///< at the impact, world axes
  float coefficient_of_restitution = 0.0F;
};

constexpr void fields(auto& visitor, Is<CollisionElastic> auto& pdu) {
  visitor("header", pdu.header);
  visitor("issuing_entity_id", pdu.issuing_entity_id);
  visitor("colliding_entity_id", pdu.colliding_entity_id);
  visitor("collision_event_id", pdu.event_id);
  visitor("padding", pdu.padding);
  visitor("contact_velocity", pdu.contact_velocity);
  visitor("mass", pdu.mass);
  visitor("location_of_impact", pdu.location_of_impact);
  visitor("collision_intermediate_result", pdu.intermediate_result);
  visitor("unit_surface_normal", pdu.unit_surface_normal);
  visitor("coefficient_of_restitution", pdu.coefficient_of_restitution);
}
static_assert(kFixedSize<CollisionElastic> == 100);

}  // namespace reckon::pdu
