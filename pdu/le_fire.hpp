// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// LE Fire PDU (type 49): a live entity fires. The body is kept
// as octets: the sources at hand do not agree on its layout.
#pragma once

#include "pdu/codec.hpp"
#include "pdu/octet_block.hpp"

namespace reckon::pdu {

struct LeFire {
  static constexpr PduType kPduType = PduType::le_fire;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::live_entity;

  PduHeader header = header_of<LeFire>();
  RestOfPdu body;
};

template <typename Visitor, Is<LeFire> Pdu>
constexpr void fields(Visitor& visitor, Pdu& pdu) {
  visitor("header", pdu.header);
  visitor.walked("body", pdu.body);
}
static_assert(kFixedSize<LeFire> == 12);

}  // namespace reckon::pdu
