// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Acknowledge (type 15, IEEE 1278.1-2012 7.5.6) and Acknowledge-R (55): the answer to create,
// remove, start and stop.
#pragma once

#include <cstdint>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/management/simulation_management.hpp"

namespace reckon::pdu {

/// The answer; `request_id` equals the request ID of the answered PDU.
template <PduType type>
struct BasicAcknowledge {
  static constexpr PduType kPduType = type;
  static constexpr ProtocolFamily kProtocolFamily = management_family(type);

  PduHeader header = header_of<BasicAcknowledge>();
  EntityId originating_entity_id;
  EntityId receiving_entity_id;
  AcknowledgeFlag acknowledge_flag = AcknowledgeFlag::create_entity;
  ResponseFlag response_flag = ResponseFlag::other;
  std::uint32_t request_id = 0;
};

using Acknowledge = BasicAcknowledge<PduType::acknowledge>;
using AcknowledgeR = BasicAcknowledge<PduType::acknowledge_r>;

constexpr void fields(auto& visitor, IsOneOf<Acknowledge, AcknowledgeR> auto& pdu) {
  management_fields(visitor, pdu);
  visitor("acknowledge_flag", pdu.acknowledge_flag);
  visitor("response_flag", pdu.response_flag);
  visitor("request_id", pdu.request_id);
}
static_assert(kFixedSize<Acknowledge> == 32);
static_assert(kFixedSize<AcknowledgeR> == 32);

}  // namespace reckon::pdu
