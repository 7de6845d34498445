// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The Entity States in a Compressed States PDU as rows, so that views and filters treat their
// fields like those in plain Entity States.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "reckon/pdu/entity/entity_state.hpp"
#include "reckon/pdu/reckon/compressed_states.hpp"
#include "reckon/tools/datagrams/pdu_row.hpp"
#include "reckon/tools/datagrams/state_keys.hpp"

namespace reckon::tools {

/// One state of a Compressed States PDU.
struct RestoredState {
  /// Its ID and offset. If it is restored, also its fields, equal to those in the plain PDU that it
  /// replaces; else the reason.
  PduRow row;
  pdu::CompressedForm form = pdu::CompressedForm::compact;
  std::size_t octets = 0;  ///< in the datagram
};

/// Restores the states of a stream, PDU after PDU. One thread. Keeps its memory from PDU to PDU,
/// 1 KiB for each state of the largest one and 1 KiB for each entity.
class RestoredStates {
 public:
  /// Limit of states of a PDU; further ones are left out. 100 fill an Ethernet frame.
  static constexpr std::size_t kMost = 512;

  /// Takes a plain Entity State of the stream, on which later ones may depend.
  void note_plain(const pdu::EntityState& state) { keys_.note_plain(state); }

  /// The states of one PDU in their order. @param around row of the PDU
  /// @returns valid until the next call
  [[nodiscard]] const std::vector<RestoredState>& restore(const pdu::CompressedStates& states,
                                                          const PduRow& around);

 private:
  struct Room {
    pdu::EntityState state;
    std::array<std::byte, pdu::kFixedSize<pdu::EntityState>> octets;
  };
  void fill(const pdu::CompressedStates& states, const pdu::CompressedState& state, Room& room,
            PduRow& row);

  StateKeys keys_;
  std::vector<RestoredState> states_;
  std::vector<Room> rooms_;  // referenced by the rows
};

}  // namespace reckon::tools
