// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cell Roles (experimental PDU 145): the cells of a peer and its time of entry, leadership and
// successor in each, and the missing parts of a cell's snapshot. A leader sends it every 0.5 s.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/record_range.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::pdu {

/// Bits of CellRole::flags.
inline constexpr std::uint16_t kRoleLeads = 1, kRoleLeaves = 2, kRoleAsks = 4;
/// In the role of the whole scene: the sender has received or sent a group map.
inline constexpr std::uint16_t kRoleMapped = 8;

/// Role of a peer in one cell.
struct CellRole {
  std::int32_t column = 0;  ///< as in CellIndex; both -2^31: the whole scene
  std::int32_t row = 0;
  std::uint64_t entered = 0;     ///< time of entry, UTC since 1970 [ns]; the earliest peer leads
  std::uint32_t successor = 0;   ///< epoch of the peer that leads after the sender; 0: none
  std::uint32_t beacon = 0;      ///< tag under which the cell can be found; 0: none
  std::uint16_t flags = 0;       ///< kRoleLeads ..
  std::uint16_t serial = 0;      ///< with kRoleAsks: of the incomplete snapshot; 0: a new one
  std::uint16_t first_part = 0;  ///< first part in `parts`
  std::uint16_t padding = 0;
  std::uint64_t parts = 0;  ///< bit i: part first_part + i is missing

  friend constexpr auto operator<=>(const CellRole&, const CellRole&) = default;
};

struct CellRoles {
  static constexpr PduType kPduType = PduType::cell_roles;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::experimental;
  static constexpr std::string_view kName = "Cell Roles";
  using Roles = Records<CellRole, std::uint16_t>;

  PduHeader header = header_of<CellRoles>();
  SimulationAddress simulation;
  std::uint32_t epoch = 0;  ///< of the sender
  std::uint16_t padding = 0;
  std::span<const std::byte> roles;  ///< 40 n octets, read with records_of<CellRole>
};

constexpr void fields(auto& visitor, Is<CellRoles> auto& pdu) {
  visitor("header", pdu.header);
  visitor("simulation_address", pdu.simulation);
  visitor("epoch", pdu.epoch);
  visitor.count("number_of_roles", pdu.roles, CellRoles::Roles{});
  visitor("padding", pdu.padding);
  visitor.records("roles", pdu.roles, CellRoles::Roles{});
}
static_assert(kFixedSize<CellRole> == 40);
static_assert(kFixedSize<CellRoles> == 24);

}  // namespace reckon::pdu
