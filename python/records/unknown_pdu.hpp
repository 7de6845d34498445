// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A PDU of a type without a field table: its header, and the rest as octets.
#pragma once

#include "reckon/pdu/codec/octet_block.hpp"
#include "reckon/pdu/codec/pdu_header.hpp"

namespace reckon::pdu {

struct UnknownPdu {
  PduHeader header;
  RestOfPdu body;
};

constexpr void fields(auto& visitor, Is<UnknownPdu> auto& pdu) {
  visitor("header", pdu.header);
  visitor.walked("body", pdu.body);
}

}  // namespace reckon::pdu

namespace reckon::python {
using pdu::UnknownPdu;
}  // namespace reckon::python
