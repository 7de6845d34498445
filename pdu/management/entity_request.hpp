// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Create Entity (type 11), Remove Entity (12) and their reliable versions (51, 52): a simulation
// manager requests the receiver to create or to remove an entity (IEEE 1278.1-2012 7.5).
#pragma once

#include <cstdint>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/management/simulation_management.hpp"

namespace reckon::pdu {

/// Requests the creation or removal of an entity; the Acknowledge repeats `request_id`.
template <PduType type>
struct EntityRequest {
  static constexpr PduType kPduType = type;
  static constexpr ProtocolFamily kProtocolFamily = management_family(type);

  PduHeader header = header_of<EntityRequest>();
  EntityId originating_entity_id;
  EntityId receiving_entity_id;
  ServiceOf<type> reliability;
  std::uint32_t request_id = 0;
};

using CreateEntity = EntityRequest<PduType::create_entity>;
using RemoveEntity = EntityRequest<PduType::remove_entity>;
using CreateEntityR = EntityRequest<PduType::create_entity_r>;
using RemoveEntityR = EntityRequest<PduType::remove_entity_r>;

constexpr void fields(auto& visitor,
                      IsOneOf<CreateEntity, RemoveEntity, CreateEntityR, RemoveEntityR> auto& pdu) {
  management_fields(visitor, pdu);
  fields(visitor, pdu.reliability);
  visitor("request_id", pdu.request_id);
}
static_assert(kFixedSize<CreateEntity> == 28);
static_assert(kFixedSize<RemoveEntity> == 28);
static_assert(kFixedSize<CreateEntityR> == 32);
static_assert(kFixedSize<RemoveEntityR> == 32);

}  // namespace reckon::pdu
