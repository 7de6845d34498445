// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Signal (type 26) and Intercom Signal (31): content of a radio transmission or of an intercom
// line.
#pragma once

#include <cstdint>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/octet_block.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::pdu {

/// A piece of sound or of data.
template <PduType type>
struct BasicSignal {
  static constexpr PduType kPduType = type;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::radio_communications;

  PduHeader header = header_of<BasicSignal>();
  EntityId reference_id;     ///< "radio_reference_id", "intercom_reference_id"
  std::uint16_t number = 0;  ///< "radio_number", "intercom_number"
  std::uint16_t encoding_scheme = 0;
  std::uint16_t tdl_type = 0;
  std::uint32_t sample_rate = 0;  ///< samples or bits a second
  BitBlock data;                  ///< count in bits
  std::uint16_t samples = 0;
};

using Signal = BasicSignal<PduType::signal>;
using IntercomSignal = BasicSignal<PduType::intercom_signal>;

template <typename Visitor, IsOneOf<Signal, IntercomSignal> Pdu>
constexpr void fields(Visitor& visitor, Pdu& pdu) {
  constexpr bool radio = Pdu::kPduType == PduType::signal;
  visitor("header", pdu.header);
  visitor(radio ? "radio_reference_id" : "intercom_reference_id", pdu.reference_id);
  visitor(radio ? "radio_number" : "intercom_number", pdu.number);
  visitor("encoding_scheme", pdu.encoding_scheme);
  visitor("tdl_type", pdu.tdl_type);
  visitor("sample_rate", pdu.sample_rate);
  visitor("data_length", pdu.data.count);
  visitor("samples", pdu.samples);
  visitor.walked("data", pdu.data);
}
static_assert(kFixedSize<Signal> == 32);
static_assert(kFixedSize<IntercomSignal> == 32);

}  // namespace reckon::pdu
