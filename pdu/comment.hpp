// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Comment PDU (type 22, IEEE 1278.1-2012 7.5.13): text for the record of an exercise.
#pragma once

#include <cstdint>
#include <span>

#include "pdu/codec.hpp"
#include "pdu/datum.hpp"
#include "pdu/records.hpp"

namespace reckon::pdu {

struct Comment {
  static constexpr PduType kPduType = PduType::comment;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::simulation_management;
  using FixedDatums = Records<FixedDatum, std::uint32_t>;

  PduHeader header = header_of<Comment>();
  EntityId originating_entity_id;
  EntityId receiving_entity_id;
  std::span<const std::byte> fixed_datums;  ///< none by the standard; kept when a sender has some
  VariableDatums variable_datums;           ///< the text
};

template <typename Visitor, Is<Comment> Pdu>
constexpr void fields(Visitor& visitor, Pdu& pdu) {
  visitor("header", pdu.header);
  visitor("originating_entity_id", pdu.originating_entity_id);
  visitor("receiving_entity_id", pdu.receiving_entity_id);
  visitor.count("number_of_fixed_datum_records", pdu.fixed_datums, Comment::FixedDatums{});
  visitor("number_of_variable_datum_records", pdu.variable_datums.count);
  visitor.records("fixed_datum_records", pdu.fixed_datums, Comment::FixedDatums{});
  visitor.walked("variable_datum_records", pdu.variable_datums);
}
static_assert(kFixedSize<Comment> == 32);

}  // namespace reckon::pdu
