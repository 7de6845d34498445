// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/peers/forger.hpp"

#include "reckon/pdu/reckon/datagram_trailer.hpp"

namespace reckon::fuzz {
namespace {

constexpr std::uint32_t kLeap = 1U << 30;

// Fills the presence that the forger sends, of itself or of its victim; false: none.
bool disguise(const Fault& fault, std::uint32_t count, std::uint32_t utc_second,
              pdu::Presence& told) {
  const auto invented = static_cast<std::uint32_t>(mixed(fault.side, count));
  switch (fault.kind) {
    case FaultKind::forged_farewell:
      told.flags |= pdu::kPresenceLeaving;
      return true;
    case FaultKind::forged_restart:
      told.epoch = invented | 1;
      told.started = utc_second;
      return true;
    case FaultKind::forged_elder:
      told.epoch = static_cast<std::uint32_t>(fault.side) | 1;
      told.started = 0;
      return true;
    case FaultKind::forged_rename:
      told.simulation.application = static_cast<std::uint16_t>(1000 + count % 100);
      return true;
    case FaultKind::flood:
      told.simulation = {66, static_cast<std::uint16_t>(1 + invented % 0xFFF0)};
      told.epoch = invented | 1;
      return true;
    default:
      return false;
  }
}

}  // namespace

PeerDatagram forged(const Fault& fault, const Life& victim, std::uint32_t count, nanoseconds utc) {
  PeerDatagram datagram;
  datagram.from = stranger();
  pdu::Presence told = victim.peer->aoim().presence().own();
  const auto second = static_cast<std::uint32_t>(utc / std::chrono::seconds(1));
  if (disguise(fault, count, second, told)) append(datagram.octets, told);
  datagram.epoch = told.epoch;

  // Every other datagram is a bare presence, as a plain sender would send it.
  if (fault.kind != FaultKind::forged_leap && count % 2 == 1) return datagram;
  pdu::DatagramTrailer trailer;
  trailer.epoch = told.epoch;
  trailer.sequence = fault.kind == FaultKind::flood ? 1 : kLeap + count;
  append(datagram.octets, trailer);
  return datagram;
}

}  // namespace reckon::fuzz
