// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Signal PDU (type 26): what a radio transmits.
#pragma once

#include <cstdint>

#include "pdu/codec.hpp"
#include "pdu/octet_block.hpp"
#include "pdu/records.hpp"

namespace reckon::pdu {

struct Signal {
  static constexpr PduType kPduType = PduType::signal;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::radio_communications;

  PduHeader header = header_of<Signal>();
  EntityId radio_reference_id;
  std::uint16_t radio_number = 0;
  std::uint16_t encoding_scheme = 0;
  std::uint16_t tdl_type = 0;
  std::uint32_t sample_rate = 0;  ///< samples or bits a second
  BitBlock data;                  ///< count in bits
  std::uint16_t samples = 0;
};

template <typename Visitor, Is<Signal> Pdu>
constexpr void fields(Visitor& visitor, Pdu& pdu) {
  visitor("header", pdu.header);
  visitor("radio_reference_id", pdu.radio_reference_id);
  visitor("radio_number", pdu.radio_number);
  visitor("encoding_scheme", pdu.encoding_scheme);
  visitor("tdl_type", pdu.tdl_type);
  visitor("sample_rate", pdu.sample_rate);
  visitor("data_length", pdu.data.count);
  visitor("samples", pdu.samples);
  visitor.walked("data", pdu.data);
}
static_assert(kFixedSize<Signal> == 32);

}  // namespace reckon::pdu
