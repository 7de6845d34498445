// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/leaders/forger.hpp"

#include "reckon/pdu/reckon/datagram_trailer.hpp"

namespace reckon::fuzz::leaders {
namespace {

constexpr std::uint32_t kUnknownLife = 0xF0F0F0F1;

template <typename Record>
std::vector<std::byte> octets_of(const std::vector<Record>& records) {
  std::vector<std::byte> octets(records.size() * pdu::kFixedSize<Record>);
  for (std::size_t i = 0; i < records.size(); ++i) {
    static_cast<void>(
        pdu::store_record(records[i], std::span(octets).subspan(i * pdu::kFixedSize<Record>)));
  }
  return octets;
}

template <typename Pdu>
Pdu signed_by(const SimulatedHost& victim, std::uint32_t epoch) {
  Pdu pdu;
  pdu.simulation = victim.aoim().presence().id();
  pdu.epoch = epoch;
  return pdu;
}

std::vector<std::byte> roles(const SimulatedHost& victim, std::uint32_t epoch,
                             std::uint16_t flags) {
  std::vector<pdu::CellRole> all;
  for (const aoim::CellId cell : {aoim::kWholeScene, victim.cell()}) {
    pdu::CellRole role;
    role.column = cell.q;
    role.row = cell.r;
    role.entered = 1;  // 1970
    role.successor = kUnknownLife;
    role.flags = flags;
    role.beacon = kForgedBeacon;
    all.push_back(role);
  }
  const auto octets = octets_of(all);
  auto pdu = signed_by<pdu::CellRoles>(victim, epoch);
  pdu.roles = octets;
  std::vector<std::byte> encoded;
  append(encoded, pdu);
  return encoded;
}

std::vector<std::byte> map(const SimulatedHost& victim, std::uint32_t epoch, std::size_t pool) {
  const auto octets = octets_of<pdu::CellGroup>({{0, 0, kForgedBeacon, 1, 0}, {1, 0, 0, 2, 0}});
  auto pdu = signed_by<pdu::GroupMap>(victim, epoch);
  pdu.version = (1U << 31) + 5;
  pdu.parts = 1;
  pdu.pool = static_cast<std::uint16_t>(pool);
  pdu.groups = octets;
  std::vector<std::byte> encoded;
  append(encoded, pdu);
  return encoded;
}

std::vector<std::byte> states(const SimulatedHost& victim, std::uint32_t epoch) {
  pdu::EntityState state;
  state.entity_id = victim.entity(0);
  state.location = {0.0, 0.0, kForgedVersion};
  std::vector<std::byte> told;
  append(told, state);
  const auto head =
      octets_of<pdu::SnapshotState>({{victim.epoch(), static_cast<std::uint16_t>(told.size())}});
  told.insert(told.begin(), head.begin(), head.end());
  auto pdu = signed_by<pdu::CellSnapshot>(victim, epoch);
  pdu.column = victim.cell().q;
  pdu.row = victim.cell().r;
  pdu.serial = 7;
  pdu.parts = 1;
  pdu.states = pdu::OctetBlock<std::uint16_t>::of(told);
  std::vector<std::byte> encoded;
  append(encoded, pdu);
  return encoded;
}

}  // namespace

std::vector<Datagram> forged(const Fault& fault, const SimulatedHost& victim) {
  std::vector<Datagram> datagrams;
  for (const std::uint32_t epoch : {victim.epoch(), kUnknownLife}) {
    Datagram datagram;
    datagram.from = stranger();
    switch (fault.kind) {
      case FaultKind::forged_claim:
        datagram.octets = roles(victim, epoch, pdu::kRoleLeads);
        break;
      case FaultKind::forged_leave:
        datagram.octets = roles(victim, epoch, pdu::kRoleLeaves | pdu::kRoleLeads);
        break;
      case FaultKind::forged_map:
        datagram.octets = map(victim, epoch, fault.pool);
        break;
      default:
        datagram.octets = states(victim, epoch);
        datagram.group = victim.group();
        break;
    }
    pdu::DatagramTrailer trailer;
    trailer.epoch = epoch;
    trailer.sequence = 1U << 30;
    append(datagram.octets, trailer);
    datagrams.push_back(datagram);
  }
  return datagrams;
}

}  // namespace reckon::fuzz::leaders
