// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// TSPI PDU (type 46): time, space and position of a live entity. The body is kept
// as octets: the sources at hand do not agree on its layout.
#pragma once

#include "pdu/codec.hpp"
#include "pdu/octet_block.hpp"

namespace reckon::pdu {

struct Tspi {
  static constexpr PduType kPduType = PduType::tspi;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::live_entity;

  PduHeader header = header_of<Tspi>();
  RestOfPdu body;
};

template <typename Visitor, Is<Tspi> Pdu>
constexpr void fields(Visitor& visitor, Pdu& pdu) {
  visitor("header", pdu.header);
  visitor.walked("body", pdu.body);
}
static_assert(kFixedSize<Tspi> == 12);

}  // namespace reckon::pdu
