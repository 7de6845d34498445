// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Entity Damage Status PDU (type 69): damage of an entity, part by part.
#pragma once

#include <cstdint>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/codec/standard_variable_record.hpp"

namespace reckon::pdu {

struct EntityDamageStatus {
  static constexpr PduType kPduType = PduType::entity_damage_status;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::warfare;

  PduHeader header = header_of<EntityDamageStatus>();
  EntityId damaged_entity_id;
  std::uint16_t padding_1 = 0;
  std::uint16_t padding_2 = 0;
  SizedRecords<StandardVariableRecord, std::uint16_t> damage_description_records;
};

constexpr void fields(auto& visitor, Is<EntityDamageStatus> auto& pdu) {
  visitor("header", pdu.header);
  visitor("damaged_entity_id", pdu.damaged_entity_id);
  visitor("padding_1", pdu.padding_1);
  visitor("padding_2", pdu.padding_2);
  visitor("number_of_damage_description_records", pdu.damage_description_records.count);
  visitor.walked("damage_description_records", pdu.damage_description_records);
}
static_assert(kFixedSize<EntityDamageStatus> == 24);

}  // namespace reckon::pdu
