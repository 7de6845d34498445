// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Comment-R PDU (type 62): Comment with reliability.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "pdu/codec.hpp"
#include "pdu/datum.hpp"
#include "pdu/records.hpp"

namespace reckon::pdu {

struct CommentR {
  static constexpr PduType kPduType = PduType::comment_r;
  static constexpr ProtocolFamily kProtocolFamily =
      ProtocolFamily::simulation_management_with_reliability;
  using FixedDatums = Records<FixedDatum, std::uint32_t>;

  PduHeader header = header_of<CommentR>();
  EntityId originating_entity_id;
  EntityId receiving_entity_id;
  std::span<const std::byte> fixed_datums;  ///< 8 n octets, read with records_of<FixedDatum>
  VariableDatums variable_datums;
};

template <typename Visitor, Is<CommentR> Pdu>
constexpr void fields(Visitor& visitor, Pdu& pdu) {
  visitor("header", pdu.header);
  visitor("originating_entity_id", pdu.originating_entity_id);
  visitor("receiving_entity_id", pdu.receiving_entity_id);
  visitor.count("number_of_fixed_datum_records", pdu.fixed_datums, CommentR::FixedDatums{});
  visitor("number_of_variable_datum_records", pdu.variable_datums.count);
  visitor.records("fixed_datum_records", pdu.fixed_datums, CommentR::FixedDatums{});
  visitor.walked("variable_datum_records", pdu.variable_datums);
}
static_assert(kFixedSize<CommentR> == 32);

}  // namespace reckon::pdu
