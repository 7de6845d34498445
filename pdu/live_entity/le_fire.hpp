// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// LE Fire PDU (type 49): a live entity fires a weapon. The bits of its flag octet, from the lowest:
// target ID; the munition ID has its own address; munition ID; the event ID has its own address;
// warhead and fuse; quantity and rate; location.
#pragma once

#include <cstdint>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/live_entity/live_entity.hpp"

namespace reckon::pdu {

struct LeFire {
  static constexpr PduType kPduType = PduType::le_fire;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::live_entity;

  PduHeader header = header_of<LeFire>();
  LiveEntityId firing_live_entity_id;
  std::uint8_t flags = 0;
  LiveShot shot;
  RelativeWorldCoordinates location;  ///< bit 6
  LiveVector<std::int16_t> velocity;  ///< [dm/s]
  std::uint16_t range = 0;
};

constexpr void fields(auto& visitor, Is<LeFire> auto& pdu) {
  visitor("header", pdu.header);
  visitor("firing_live_entity_id", pdu.firing_live_entity_id);
  visitor("fire_flags", pdu.flags);
  id_fields(visitor, pdu.shot, pdu.flags, true);
  when(has_flag(pdu.flags, 6), visitor, "location", pdu.location);
  munition_fields(visitor, pdu.shot, pdu.flags);
  when(true, visitor, "velocity", pdu.velocity);
  when(true, visitor, "range", pdu.range);
}
static_assert(kFixedSize<LeFire> == 17);

}  // namespace reckon::pdu
