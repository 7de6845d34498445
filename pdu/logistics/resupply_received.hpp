// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Resupply Received PDU (type 7): supplies that were received.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/logistics/supply_quantity.hpp"

namespace reckon::pdu {

struct ResupplyReceived {
  static constexpr PduType kPduType = PduType::resupply_received;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::logistics;
  using Supplies = Records<SupplyQuantity, std::uint8_t>;

  PduHeader header = header_of<ResupplyReceived>();
  EntityId receiving_entity_id;
  EntityId supplying_entity_id;
  std::span<const std::byte> supplies;  ///< read with records_of<SupplyQuantity>
  std::uint8_t padding_1 = 0;
  std::uint16_t padding_2 = 0;
};

constexpr void fields(auto& visitor, Is<ResupplyReceived> auto& pdu) {
  visitor("header", pdu.header);
  visitor("receiving_entity_id", pdu.receiving_entity_id);
  visitor("supplying_entity_id", pdu.supplying_entity_id);
  visitor.count("number_of_supply_types", pdu.supplies, ResupplyReceived::Supplies{});
  visitor("padding_1", pdu.padding_1);
  visitor("padding_2", pdu.padding_2);
  visitor.records("supplies", pdu.supplies, ResupplyReceived::Supplies{});
}
static_assert(kFixedSize<ResupplyReceived> == 28);

}  // namespace reckon::pdu
