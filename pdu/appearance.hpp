// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Appearance PDU (type 47): how a live entity looks. The body is kept
// as octets: the sources at hand do not agree on its layout.
#pragma once

#include "pdu/codec.hpp"
#include "pdu/octet_block.hpp"

namespace reckon::pdu {

struct Appearance {
  static constexpr PduType kPduType = PduType::appearance;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::live_entity;

  PduHeader header = header_of<Appearance>();
  RestOfPdu body;
};

template <typename Visitor, Is<Appearance> Pdu>
constexpr void fields(Visitor& visitor, Pdu& pdu) {
  visitor("header", pdu.header);
  visitor.walked("body", pdu.body);
}
static_assert(kFixedSize<Appearance> == 12);

}  // namespace reckon::pdu
