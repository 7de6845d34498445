// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Group Map (experimental PDU 146): the groups of the cells, sent by the leader of the scene. A map
// with more cells than one PDU holds is sent in parts of one version.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/record_range.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::pdu {

/// The group of one cell.
struct CellGroup {
  std::int32_t column = 0;  ///< as in CellIndex
  std::int32_t row = 0;
  std::uint32_t beacon = 0;  ///< tag under which the cell can be found; 0: none
  std::uint16_t group = 0;   ///< 1 .. pool; 0: the row only has a beacon
  std::uint16_t padding = 0;

  friend constexpr auto operator<=>(const CellGroup&, const CellGroup&) = default;
};

struct GroupMap {
  static constexpr PduType kPduType = PduType::group_map;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::experimental;
  static constexpr std::string_view kName = "Group Map";
  using Groups = Records<CellGroup, std::uint16_t>;

  PduHeader header = header_of<GroupMap>();
  SimulationAddress simulation;
  std::uint32_t epoch = 0;    ///< of the sender
  std::uint32_t version = 0;  ///< of the map; a higher one replaces the earlier ones
  std::uint16_t part = 0;     ///< 0 .. parts - 1
  std::uint16_t parts = 0;
  std::uint16_t pool = 0;             ///< groups that may be handed out
  std::span<const std::byte> groups;  ///< 16 n octets, read with records_of<CellGroup>
};

constexpr void fields(auto& visitor, Is<GroupMap> auto& pdu) {
  visitor("header", pdu.header);
  visitor("simulation_address", pdu.simulation);
  visitor("epoch", pdu.epoch);
  visitor("version", pdu.version);
  visitor("part", pdu.part);
  visitor("parts", pdu.parts);
  visitor("pool", pdu.pool);
  visitor.count("number_of_groups", pdu.groups, GroupMap::Groups{});
  visitor.records("groups", pdu.groups, GroupMap::Groups{});
}
static_assert(kFixedSize<CellGroup> == 16);
static_assert(kFixedSize<GroupMap> == 32);

}  // namespace reckon::pdu
