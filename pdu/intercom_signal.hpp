// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Intercom Signal PDU (type 31): what is said on an intercom.
#pragma once

#include <cstdint>

#include "pdu/codec.hpp"
#include "pdu/octet_block.hpp"
#include "pdu/records.hpp"

namespace reckon::pdu {

struct IntercomSignal {
  static constexpr PduType kPduType = PduType::intercom_signal;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::radio_communications;

  PduHeader header = header_of<IntercomSignal>();
  EntityId intercom_reference_id;
  std::uint16_t intercom_number = 0;
  std::uint16_t encoding_scheme = 0;
  std::uint16_t tdl_type = 0;
  std::uint32_t sample_rate = 0;  ///< samples or bits a second
  BitBlock data;                  ///< count in bits
  std::uint16_t samples = 0;
};

template <typename Visitor, Is<IntercomSignal> Pdu>
constexpr void fields(Visitor& visitor, Pdu& pdu) {
  visitor("header", pdu.header);
  visitor("intercom_reference_id", pdu.intercom_reference_id);
  visitor("intercom_number", pdu.intercom_number);
  visitor("encoding_scheme", pdu.encoding_scheme);
  visitor("tdl_type", pdu.tdl_type);
  visitor("sample_rate", pdu.sample_rate);
  visitor("data_length", pdu.data.count);
  visitor("samples", pdu.samples);
  visitor.walked("data", pdu.data);
}
static_assert(kFixedSize<IntercomSignal> == 32);

}  // namespace reckon::pdu
