// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Sends a PDU other than an entity state from a stage of the model loop.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <optional>
#include <span>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/pdu/codec/codec.hpp"

namespace reckon::peer {

/// Queues it for the peers that can sense `place` [m, S], or for all.
/// @param pdu at most 512 octets
template <pdu::Pdu T>
void send_pdu(aoim::AreaOfInterestManager& aoim, const T& pdu,
              const std::optional<aoim::Position>& place, std::chrono::nanoseconds now) noexcept {
  std::array<std::byte, 512> octets;
  const std::size_t size = pdu::encode(pdu, octets);
  const std::size_t tier = place ? aoim::kCellTier : aoim::kEverybody;
  static_cast<void>(aoim.send(tier, aoim::PduPayload{std::span(octets.data(), size)},
                              place.value_or(aoim::Position{}), now));
}

}  // namespace reckon::peer
