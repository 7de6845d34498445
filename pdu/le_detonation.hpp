// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// LE Detonation PDU (type 50): a munition of a live entity explodes. The body is kept
// as octets: the sources at hand do not agree on its layout.
#pragma once

#include "pdu/codec.hpp"
#include "pdu/octet_block.hpp"

namespace reckon::pdu {

struct LeDetonation {
  static constexpr PduType kPduType = PduType::le_detonation;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::live_entity;

  PduHeader header = header_of<LeDetonation>();
  RestOfPdu body;
};

template <typename Visitor, Is<LeDetonation> Pdu>
constexpr void fields(Visitor& visitor, Pdu& pdu) {
  visitor("header", pdu.header);
  visitor.walked("body", pdu.body);
}
static_assert(kFixedSize<LeDetonation> == 12);

}  // namespace reckon::pdu
