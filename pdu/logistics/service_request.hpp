// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Service Request PDU (type 5): requests supplies or repair from another entity.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/logistics/supply_quantity.hpp"

namespace reckon::pdu {

struct ServiceRequest {
  static constexpr PduType kPduType = PduType::service_request;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::logistics;
  using Supplies = Records<SupplyQuantity, std::uint8_t>;

  PduHeader header = header_of<ServiceRequest>();
  EntityId requesting_entity_id;
  EntityId servicing_entity_id;
  std::uint8_t service_type_requested = 0;
  std::span<const std::byte> supplies;  ///< read with records_of<SupplyQuantity>
  std::uint16_t padding = 0;
};

constexpr void fields(auto& visitor, Is<ServiceRequest> auto& pdu) {
  visitor("header", pdu.header);
  visitor("requesting_entity_id", pdu.requesting_entity_id);
  visitor("servicing_entity_id", pdu.servicing_entity_id);
  visitor("service_type_requested", pdu.service_type_requested);
  visitor.count("number_of_supply_types", pdu.supplies, ServiceRequest::Supplies{});
  visitor("padding", pdu.padding);
  visitor.records("supplies", pdu.supplies, ServiceRequest::Supplies{});
}
static_assert(kFixedSize<ServiceRequest> == 28);

}  // namespace reckon::pdu
