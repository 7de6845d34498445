// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What the area-of-interest manager sends of an entity or an event.
#pragma once

#include <cstddef>
#include <span>
#include <variant>

#include "reckon/pdu/entity/entity_state.hpp"
#include "reckon/pdu/reckon/compressed_states.hpp"

namespace reckon::aoim {

/// An Entity State with the records of its force model and energy accounts, encoded, may be empty.
struct StatePayload {
  const pdu::EntityState& state;
  std::span<const std::byte> records = {};
};

/// The same with the state in a compressed form, as pdu::store_compressed() wrote it.
struct CompressedPayload {
  pdu::EntityId entity;
  pdu::CompressedForm form;
  std::span<const std::byte> state;
  std::span<const std::byte> records = {};
};

/// Any other encoded PDU.
struct PduPayload {
  std::span<const std::byte> octets;
};

/// Views: what they show has to live until it was handed over.
using UpdatePayload = std::variant<StatePayload, CompressedPayload, PduPayload>;

}  // namespace reckon::aoim
