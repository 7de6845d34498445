// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// IsGroupOf PDU (type 34): entities that one simulation shows as a group. Their descriptions are
// kept as octets.
#pragma once

#include <cstdint>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/octet_block.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::pdu {

struct IsGroupOf {
  static constexpr PduType kPduType = PduType::is_group_of;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::entity_management;

  PduHeader header = header_of<IsGroupOf>();
  EntityId group_entity_id;
  std::uint8_t grouped_entity_category = 0;
  std::uint8_t number_of_grouped_entities = 0;
  std::uint32_t padding = 0;
  double latitude = 0.0;
  double longitude = 0.0;
  RestOfPdu grouped_entity_descriptions;
};

template <typename Visitor, Is<IsGroupOf> Pdu>
constexpr void fields(Visitor& visitor, Pdu& pdu) {
  visitor("header", pdu.header);
  visitor("group_entity_id", pdu.group_entity_id);
  visitor("grouped_entity_category", pdu.grouped_entity_category);
  visitor("number_of_grouped_entities", pdu.number_of_grouped_entities);
  visitor("padding", pdu.padding);
  visitor("latitude", pdu.latitude);
  visitor("longitude", pdu.longitude);
  visitor.walked("grouped_entity_descriptions", pdu.grouped_entity_descriptions);
}
static_assert(kFixedSize<IsGroupOf> == 40);

}  // namespace reckon::pdu
