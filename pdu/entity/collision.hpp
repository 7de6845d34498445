// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Collision PDU (type 4, IEEE 1278.1-2012 7.2.3): collision of two entities, without rebound.
#pragma once

#include <cstdint>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::pdu {

struct Collision {
  static constexpr PduType kPduType = PduType::collision;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::entity_information_interaction;

  PduHeader header = header_of<Collision>();
  EntityId issuing_entity_id;
  EntityId colliding_entity_id;
  EventId event_id;
  CollisionType collision_type = CollisionType::inelastic;
  std::uint8_t padding = 0;
  Vector3Float velocity;  ///< of the issuing entity, world axes [m/s]
  float mass = 0.0F;      ///< of the issuing entity [kg]
  Vector3Float location;  ///< of the impact, body axes of the other entity [m]
};
static_assert(kFixedSize<Collision> == 60);

}  // namespace reckon::pdu
