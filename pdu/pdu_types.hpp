// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// THE list of PDU types with a field table. A new PDU is one header and one row here (and one
// golden sample for the tests); codec, printer, JSON, tests and bench follow from it.
#pragma once

#include <cstddef>
#include <span>
#include <utility>

#include "pdu/acknowledge.hpp"
#include "pdu/attribute.hpp"
#include "pdu/cell_membership.hpp"
#include "pdu/codec.hpp"
#include "pdu/collision.hpp"
#include "pdu/collision_elastic.hpp"
#include "pdu/comment.hpp"
#include "pdu/create_entity.hpp"
#include "pdu/data.hpp"
#include "pdu/datagram_trailer.hpp"
#include "pdu/entity_state.hpp"
#include "pdu/presence.hpp"
#include "pdu/remove_entity.hpp"
#include "pdu/start_resume.hpp"
#include "pdu/stop_freeze.hpp"

namespace reckon::pdu {

template <typename... T>
struct TypeList {
  static constexpr std::size_t kSize = sizeof...(T);
};

using PduTypes = TypeList<EntityState, Attribute, CollisionElastic, Collision, StartResume,
                          StopFreeze, Acknowledge, CreateEntity, RemoveEntity, Data, Comment,
                          Presence, DatagramTrailer, CellMembership>;

/// True where the list holds the type.
template <typename... T>
[[nodiscard]] constexpr bool is_listed(PduType type, TypeList<T...>) noexcept {
  return ((T::kPduType == type) || ...);
}
[[nodiscard]] constexpr bool is_listed(PduType type) noexcept {
  return is_listed(type, PduTypes{});
}

/// Decodes `bytes` (one PDU or longer) as the type its header names and calls `f(const T&)`; on any
/// error `f` is not called. unknown_type: not in the list, the octets are the caller's to keep.
template <typename F, typename... T>
[[nodiscard]] DecodeError visit(std::span<const std::byte> bytes, const PduHeader& header, F&& f,
                                TypeList<T...>) {
  DecodeError error = DecodeError::unknown_type;
  const auto attempt = [&]<typename Candidate>(std::type_identity<Candidate>) {
    if (Candidate::kPduType != header.pdu_type) return false;
    Candidate pdu;
    error = decode(bytes, pdu);
    if (error == DecodeError::none) f(std::as_const(pdu));
    return true;
  };
  static_cast<void>((attempt(std::type_identity<T>{}) || ...));
  return error;
}
template <typename F>
[[nodiscard]] DecodeError visit(std::span<const std::byte> bytes, const PduHeader& header, F&& f) {
  return visit(bytes, header, std::forward<F>(f), PduTypes{});
}

}  // namespace reckon::pdu
