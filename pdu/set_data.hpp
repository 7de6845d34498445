// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Set Data PDU (type 19): sets data in another simulation.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "pdu/codec.hpp"
#include "pdu/datum.hpp"
#include "pdu/records.hpp"

namespace reckon::pdu {

struct SetData {
  static constexpr PduType kPduType = PduType::set_data;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::simulation_management;
  using FixedDatums = Records<FixedDatum, std::uint32_t>;

  PduHeader header = header_of<SetData>();
  EntityId originating_entity_id;
  EntityId receiving_entity_id;
  std::uint32_t request_id = 0;
  std::uint32_t padding = 0;
  std::span<const std::byte> fixed_datums;  ///< 8 n octets, read with records_of<FixedDatum>
  VariableDatums variable_datums;
};

template <typename Visitor, Is<SetData> Pdu>
constexpr void fields(Visitor& visitor, Pdu& pdu) {
  visitor("header", pdu.header);
  visitor("originating_entity_id", pdu.originating_entity_id);
  visitor("receiving_entity_id", pdu.receiving_entity_id);
  visitor("request_id", pdu.request_id);
  visitor("padding", pdu.padding);
  visitor.count("number_of_fixed_datum_records", pdu.fixed_datums, SetData::FixedDatums{});
  visitor("number_of_variable_datum_records", pdu.variable_datums.count);
  visitor.records("fixed_datum_records", pdu.fixed_datums, SetData::FixedDatums{});
  visitor.walked("variable_datum_records", pdu.variable_datums);
}
static_assert(kFixedSize<SetData> == 40);

}  // namespace reckon::pdu
