// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Action Response (type 17) and Action Response-R (57): the answer to a request for an action.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/management/datum.hpp"
#include "reckon/pdu/management/simulation_management.hpp"

namespace reckon::pdu {

/// The answer to an Action Request.
template <PduType type>
struct BasicActionResponse {
  static constexpr PduType kPduType = type;
  static constexpr ProtocolFamily kProtocolFamily = management_family(type);

  PduHeader header = header_of<BasicActionResponse>();
  EntityId originating_entity_id;
  EntityId receiving_entity_id;
  std::uint32_t request_id = 0;
  std::uint32_t request_status = 0;         ///< "response status" in the reliable PDU
  std::span<const std::byte> fixed_datums;  ///< 8 n octets, read with records_of<FixedDatum>
  VariableDatums variable_datums;
};

using ActionResponse = BasicActionResponse<PduType::action_response>;
using ActionResponseR = BasicActionResponse<PduType::action_response_r>;

template <typename Visitor, IsOneOf<ActionResponse, ActionResponseR> Pdu>
constexpr void fields(Visitor& visitor, Pdu& pdu) {
  management_fields(visitor, pdu);
  visitor("request_id", pdu.request_id);
  visitor(is_reliable(Pdu::kPduType) ? "response_status" : "request_status", pdu.request_status);
  datum_fields(visitor, pdu);
}
static_assert(kFixedSize<ActionResponse> == 40);
static_assert(kFixedSize<ActionResponseR> == 40);

}  // namespace reckon::pdu
