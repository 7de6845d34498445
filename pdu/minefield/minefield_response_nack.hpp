// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Minefield Response NACK PDU (type 40): requests lost Minefield Data again.
#pragma once

#include <cstdint>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/octet_block.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::pdu {

struct MinefieldResponseNack {
  static constexpr PduType kPduType = PduType::minefield_response_nack;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::minefield;

  PduHeader header = header_of<MinefieldResponseNack>();
  EntityId minefield_id;
  EntityId requesting_entity_id;
  std::uint8_t request_id = 0;
  OctetBlock<std::uint8_t> missing_pdu_sequence_numbers;
  RestOfPdu padding_to_32_bits;
};

constexpr void fields(auto& visitor, Is<MinefieldResponseNack> auto& pdu) {
  visitor("header", pdu.header);
  visitor("minefield_id", pdu.minefield_id);
  visitor("requesting_entity_id", pdu.requesting_entity_id);
  visitor("request_id", pdu.request_id);
  visitor("number_of_missing_pdus", pdu.missing_pdu_sequence_numbers.count);
  visitor.walked("missing_pdu_sequence_numbers", pdu.missing_pdu_sequence_numbers);
  visitor.walked("padding_to_32_bits", pdu.padding_to_32_bits);
}
static_assert(kFixedSize<MinefieldResponseNack> == 26);

}  // namespace reckon::pdu
