// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Intercom Control PDU (type 32): requests and states of an intercom line.
#pragma once

#include <cstdint>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/octet_block.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::pdu {

struct IntercomControl {
  static constexpr PduType kPduType = PduType::intercom_control;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::radio_communications;

  PduHeader header = header_of<IntercomControl>();
  std::uint8_t control_type = 0;
  std::uint8_t communications_channel_type = 0;
  EntityId source_entity_id;
  std::uint16_t source_intercom_number = 0;
  std::uint8_t source_line_id = 0;
  std::uint8_t transmit_priority = 0;
  std::uint8_t transmit_line_state = 0;
  std::uint8_t command = 0;
  EntityId master_intercom_reference_id;
  std::uint16_t master_intercom_number = 0;
  std::uint16_t master_channel_id = 0;
  OctetBlock<std::uint32_t> intercom_parameters;
};

constexpr void fields(auto& visitor, Is<IntercomControl> auto& pdu) {
  visitor("header", pdu.header);
  visitor("control_type", pdu.control_type);
  visitor("communications_channel_type", pdu.communications_channel_type);
  visitor("source_entity_id", pdu.source_entity_id);
  visitor("source_intercom_number", pdu.source_intercom_number);
  visitor("source_line_id", pdu.source_line_id);
  visitor("transmit_priority", pdu.transmit_priority);
  visitor("transmit_line_state", pdu.transmit_line_state);
  visitor("command", pdu.command);
  visitor("master_intercom_reference_id", pdu.master_intercom_reference_id);
  visitor("master_intercom_number", pdu.master_intercom_number);
  visitor("master_channel_id", pdu.master_channel_id);
  visitor("length_of_intercom_parameters", pdu.intercom_parameters.count);
  visitor.walked("intercom_parameters", pdu.intercom_parameters);
}
static_assert(kFixedSize<IntercomControl> == 40);

}  // namespace reckon::pdu
