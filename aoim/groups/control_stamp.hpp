// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Sender and time in every control PDU of a peer.
#pragma once

#include <chrono>
#include <cstdint>

#include "reckon/aoim/groups/peer_id.hpp"

namespace reckon::aoim {

/// The sender of a control PDU, and its creation time.
struct ControlStamp {
  std::uint8_t exercise = 0;
  PeerId simulation;
  std::uint32_t epoch = 0;
  std::uint32_t timestamp = 0;     ///< DIS timestamp of `utc`
  std::chrono::nanoseconds utc{};  ///< since 1970

  /// Fills in the header, the simulation and the epoch.
  void put(auto& pdu) const noexcept {
    pdu.header.exercise_id = exercise;
    pdu.header.timestamp = timestamp;
    pdu.simulation = simulation;
    pdu.epoch = epoch;
  }
};

}  // namespace reckon::aoim
