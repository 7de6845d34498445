// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Set Data (type 19) and Set Data-R (59): sets data in another simulation.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/management/datum.hpp"
#include "reckon/pdu/management/simulation_management.hpp"

namespace reckon::pdu {

/// Sets data in another simulation.
template <PduType type>
struct BasicSetData {
  static constexpr PduType kPduType = type;
  static constexpr ProtocolFamily kProtocolFamily = management_family(type);

  PduHeader header = header_of<BasicSetData>();
  EntityId originating_entity_id;
  EntityId receiving_entity_id;
  ServiceOf<type> reliability;
  std::uint32_t request_id = 0;
  std::conditional_t<is_reliable(type), NoService, ServicePadding> padding;
  std::span<const std::byte> fixed_datums;  ///< 8 n octets, read with records_of<FixedDatum>
  VariableDatums variable_datums;
};

using SetData = BasicSetData<PduType::set_data>;
using SetDataR = BasicSetData<PduType::set_data_r>;

constexpr void fields(auto& visitor, IsOneOf<SetData, SetDataR> auto& pdu) {
  management_fields(visitor, pdu);
  fields(visitor, pdu.reliability);
  visitor("request_id", pdu.request_id);
  fields(visitor, pdu.padding);
  datum_fields(visitor, pdu);
}
static_assert(kFixedSize<SetData> == 40);
static_assert(kFixedSize<SetDataR> == 40);

}  // namespace reckon::pdu
