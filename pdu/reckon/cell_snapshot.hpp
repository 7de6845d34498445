// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cell Snapshot (experimental PDU 147): the last states of the entities of a cell, relayed by its
// leader to newcomers, in numbered parts.
#pragma once

#include <cstdint>
#include <string_view>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/octet_block.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::pdu {

/// Precedes each state of a snapshot.
struct SnapshotState {
  std::uint32_t epoch = 0;   ///< epoch of the entity's owner
  std::uint16_t length = 0;  ///< of the following [octets]: an Entity State PDU, and its
                             ///< HapticRecord and OwnershipRecord if it has them
  std::uint16_t age = 0;     ///< since the leader received it [10 ms]; 65,535 also stands for more

  friend constexpr auto operator<=>(const SnapshotState&, const SnapshotState&) = default;
};

struct CellSnapshot {
  static constexpr PduType kPduType = PduType::cell_snapshot;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::experimental;
  static constexpr std::string_view kName = "Cell Snapshot";

  PduHeader header = header_of<CellSnapshot>();
  SimulationAddress simulation;
  std::uint32_t epoch = 0;  ///< of the sender, the leader of the cell
  std::int32_t column = 0;  ///< as in CellIndex
  std::int32_t row = 0;
  std::uint16_t serial = 0;  ///< of the snapshot, from 1 on
  std::uint16_t part = 0;    ///< 0 .. parts - 1
  std::uint16_t parts = 0;
  OctetBlock<std::uint16_t> states;  ///< each a SnapshotState and its octets
};

constexpr void fields(auto& visitor, Is<CellSnapshot> auto& pdu) {
  visitor("header", pdu.header);
  visitor("simulation_address", pdu.simulation);
  visitor("epoch", pdu.epoch);
  visitor("column", pdu.column);
  visitor("row", pdu.row);
  visitor("serial", pdu.serial);
  visitor("part", pdu.part);
  visitor("parts", pdu.parts);
  visitor("states_length", pdu.states.count);
  visitor.walked("states", pdu.states);
}
static_assert(kFixedSize<SnapshotState> == 8);
static_assert(kFixedSize<CellSnapshot> == 36);

}  // namespace reckon::pdu
