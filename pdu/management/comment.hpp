// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Comment (type 22) and Comment-R (62): text and other datums without an answer.
#pragma once

#include <cstddef>
#include <span>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/management/datum.hpp"
#include "reckon/pdu/management/simulation_management.hpp"

namespace reckon::pdu {

/// A note from one simulation to another.
template <PduType type>
struct BasicComment {
  static constexpr PduType kPduType = type;
  static constexpr ProtocolFamily kProtocolFamily = management_family(type);

  PduHeader header = header_of<BasicComment>();
  EntityId originating_entity_id;
  EntityId receiving_entity_id;
  std::span<const std::byte> fixed_datums;  ///< 8 n octets, read with records_of<FixedDatum>
  VariableDatums variable_datums;
};

using Comment = BasicComment<PduType::comment>;
using CommentR = BasicComment<PduType::comment_r>;

constexpr void fields(auto& visitor, IsOneOf<Comment, CommentR> auto& pdu) {
  management_fields(visitor, pdu);
  datum_fields(visitor, pdu);
}
static_assert(kFixedSize<Comment> == 32);
static_assert(kFixedSize<CommentR> == 32);

}  // namespace reckon::pdu
