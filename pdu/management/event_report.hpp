// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Event Report (type 21) and Event Report-R (61): reports an event to a manager.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/management/datum.hpp"
#include "reckon/pdu/management/simulation_management.hpp"

namespace reckon::pdu {

/// Reports an event to a manager.
template <PduType type>
struct BasicEventReport {
  static constexpr PduType kPduType = type;
  static constexpr ProtocolFamily kProtocolFamily = management_family(type);

  PduHeader header = header_of<BasicEventReport>();
  EntityId originating_entity_id;
  EntityId receiving_entity_id;
  std::uint32_t event_type = 0;
  std::uint32_t padding = 0;
  std::span<const std::byte> fixed_datums;  ///< 8 n octets, read with records_of<FixedDatum>
  VariableDatums variable_datums;
};

using EventReport = BasicEventReport<PduType::event_report>;
using EventReportR = BasicEventReport<PduType::event_report_r>;

constexpr void fields(auto& visitor, IsOneOf<EventReport, EventReportR> auto& pdu) {
  management_fields(visitor, pdu);
  visitor("event_type", pdu.event_type);
  visitor("padding", pdu.padding);
  datum_fields(visitor, pdu);
}
static_assert(kFixedSize<EventReport> == 40);
static_assert(kFixedSize<EventReportR> == 40);

}  // namespace reckon::pdu
