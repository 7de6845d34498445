// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Receiver PDU (type 27): a radio receiver and its received transmitter.
#pragma once

#include <cstdint>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::pdu {

struct Receiver {
  static constexpr PduType kPduType = PduType::receiver;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::radio_communications;

  PduHeader header = header_of<Receiver>();
  EntityId radio_reference_id;
  std::uint16_t radio_number = 0;
  std::uint16_t receiver_state = 0;
  std::uint16_t padding = 0;
  float received_power = 0.0F;  ///< [dBm]
  EntityId transmitter_radio_reference_id;
  std::uint16_t transmitter_radio_number = 0;
};
static_assert(kFixedSize<Receiver> == 36);

}  // namespace reckon::pdu
