// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Articulated Parts PDU (type 48): moving parts of a live entity. The body is kept
// as octets: the sources at hand do not agree on its layout.
#pragma once

#include "pdu/codec.hpp"
#include "pdu/octet_block.hpp"

namespace reckon::pdu {

struct ArticulatedParts {
  static constexpr PduType kPduType = PduType::articulated_parts;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::live_entity;

  PduHeader header = header_of<ArticulatedParts>();
  RestOfPdu body;
};

template <typename Visitor, Is<ArticulatedParts> Pdu>
constexpr void fields(Visitor& visitor, Pdu& pdu) {
  visitor("header", pdu.header);
  visitor.walked("body", pdu.body);
}
static_assert(kFixedSize<ArticulatedParts> == 12);

}  // namespace reckon::pdu
