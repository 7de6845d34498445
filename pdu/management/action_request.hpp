// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Action Request (type 16) and Action Request-R (56): requests an action of a simulation.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/management/datum.hpp"
#include "reckon/pdu/management/simulation_management.hpp"

namespace reckon::pdu {

/// Requests an action.
template <PduType type>
struct BasicActionRequest {
  static constexpr PduType kPduType = type;
  static constexpr ProtocolFamily kProtocolFamily = management_family(type);

  PduHeader header = header_of<BasicActionRequest>();
  EntityId originating_entity_id;
  EntityId receiving_entity_id;
  ServiceOf<type> reliability;
  std::uint32_t request_id = 0;
  std::uint32_t action_id = 0;
  std::span<const std::byte> fixed_datums;  ///< 8 n octets, read with records_of<FixedDatum>
  VariableDatums variable_datums;
};

using ActionRequest = BasicActionRequest<PduType::action_request>;
using ActionRequestR = BasicActionRequest<PduType::action_request_r>;

constexpr void fields(auto& visitor, IsOneOf<ActionRequest, ActionRequestR> auto& pdu) {
  management_fields(visitor, pdu);
  fields(visitor, pdu.reliability);
  visitor("request_id", pdu.request_id);
  visitor("action_id", pdu.action_id);
  datum_fields(visitor, pdu);
}
static_assert(kFixedSize<ActionRequest> == 40);
static_assert(kFixedSize<ActionRequestR> == 44);

}  // namespace reckon::pdu
