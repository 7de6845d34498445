// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Data (type 20, IEEE 1278.1-2012 7.5.11) and Data-R (60): tagged values in answer to a query, or
// without one. Data-R has its reliability after the request ID, Set Data-R before it, as in the
// schemas of opendis7 and xmlpg, KDIS and dis-rs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/management/datum.hpp"
#include "reckon/pdu/management/simulation_management.hpp"

namespace reckon::pdu {

/// Tagged values in answer to a query, or without one.
template <PduType type>
struct BasicData {
  static constexpr PduType kPduType = type;
  static constexpr ProtocolFamily kProtocolFamily = management_family(type);

  PduHeader header = header_of<BasicData>();
  EntityId originating_entity_id;
  EntityId receiving_entity_id;
  std::uint32_t request_id = 0;
  ServiceOf<type, ServicePadding> reliability;
  std::span<const std::byte> fixed_datums;  ///< 8 n octets, read with records_of<FixedDatum>
  VariableDatums variable_datums;
};

using Data = BasicData<PduType::data>;
using DataR = BasicData<PduType::data_r>;

constexpr void fields(auto& visitor, IsOneOf<Data, DataR> auto& pdu) {
  management_fields(visitor, pdu);
  visitor("request_id", pdu.request_id);
  fields(visitor, pdu.reliability);
  datum_fields(visitor, pdu);
}
static_assert(kFixedSize<Data> == 40);
static_assert(kFixedSize<DataR> == 40);

}  // namespace reckon::pdu
