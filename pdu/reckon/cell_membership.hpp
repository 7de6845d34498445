// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cell membership (experimental PDU 142): a peer joins or leaves cells, or takes or gives up their
// leadership.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/record_range.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::pdu {

/// Column and row of a cell; axial coordinates q and r in a hexagonal scheme.
struct CellIndex {
  std::int32_t column = 0;
  std::int32_t row = 0;

  friend constexpr auto operator<=>(const CellIndex&, const CellIndex&) = default;
};

struct CellMembership {
  static constexpr PduType kPduType = PduType::cell_membership;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::experimental;
  static constexpr std::string_view kName = "Cell Membership";
  using Cells = Records<CellIndex, std::uint16_t>;

  PduHeader header = header_of<CellMembership>();
  SimulationAddress simulation;
  std::uint32_t epoch = 0;
  MembershipAction action = MembershipAction::none;
  std::uint8_t near_row = 0;  ///< of join_near: the near row; the nearest is 0
  std::uint64_t since = 0;    ///< start of the membership, UTC since 1970 [ns]; the earliest leads
  std::span<const std::byte> cells;  ///< 8 n octets, read with records_of<CellIndex>
};

constexpr void fields(auto& visitor, Is<CellMembership> auto& pdu) {
  visitor("header", pdu.header);
  visitor("simulation_address", pdu.simulation);
  visitor("epoch", pdu.epoch);
  visitor("action", pdu.action);
  visitor("near_row", pdu.near_row);
  visitor.count("number_of_cells", pdu.cells, CellMembership::Cells{});
  visitor("since", pdu.since);
  visitor.records("cells", pdu.cells, CellMembership::Cells{});
}
static_assert(kFixedSize<CellMembership> == 32);

}  // namespace reckon::pdu
