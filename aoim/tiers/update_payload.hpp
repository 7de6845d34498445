// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Payload of an update that the area-of-interest manager sends: an entity's state or an event.
#pragma once

#include <cstddef>
#include <span>
#include <variant>

#include "reckon/pdu/entity/entity_state.hpp"
#include "reckon/pdu/reckon/compressed_states.hpp"

namespace reckon::aoim {

/// An Entity State with the encoded records of its force model and energy accounts, which may be
/// empty.
struct StatePayload {
  const pdu::EntityState& state;
  std::span<const std::byte> records = {};
};

/// The same with the state in a compressed form, as written by pdu::store_compressed().
struct CompressedPayload {
  pdu::EntityId entity;
  pdu::CompressedForm form;
  std::span<const std::byte> state;
  std::span<const std::byte> records = {};
};

/// Any other encoded PDU.
struct PduPayload {
  std::span<const std::byte> octets;
  std::span<const std::byte> mark = {};  ///< an experimental PDU for the same datagram, or empty
};

/// Views: the data must stay valid until the payload was handed over.
using UpdatePayload = std::variant<StatePayload, CompressedPayload, PduPayload>;

}  // namespace reckon::aoim
