// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Recipients of a simulation management PDU: one entity, one simulation or all; and IDs that no
// entity has.
#pragma once

#include <cstdint>

#include "reckon/pdu/codec/records.hpp"

namespace reckon::peer {

/// Site, application or entity number that addresses all of them.
inline constexpr std::uint16_t kEverybody = 0xFFFF;

/// Whether `receiver` addresses the simulation `own` or one of its entities.
[[nodiscard]] constexpr bool is_addressed(const pdu::EntityId& receiver,
                                          const pdu::SimulationAddress& own) noexcept {
  const auto matches = [](std::uint16_t wanted, std::uint16_t mine) {
    return wanted == mine || wanted == kEverybody;
  };
  return matches(receiver.site, own.site) && matches(receiver.application, own.application);
}

/// Whether it addresses the whole simulation: entity 0, or all.
[[nodiscard]] constexpr bool is_whole(const pdu::EntityId& receiver) noexcept {
  return receiver.entity == 0 || receiver.entity == kEverybody;
}

/// Whether an entity can have this ID. In each of the three numbers, 0 means none (NO_SITE,
/// NO_APPLIC, NO_ENTITY) and 65535 means all; entity 65534 has no number yet (RQST_ASSIGN_ID). IEEE
/// 1278.1-2012 6.2.28, 6.2.80.
[[nodiscard]] constexpr bool is_nameable(const pdu::EntityId& id) noexcept {
  constexpr std::uint16_t kAsksForNumber = 0xFFFE;
  const auto is_given = [](std::uint16_t number) { return number != 0 && number != kEverybody; };
  return is_given(id.site) && is_given(id.application) && is_given(id.entity) &&
         id.entity != kAsksForNumber;
}

}  // namespace reckon::peer
