// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// LE Detonation PDU (type 50): a munition of a live entity detonates. Its first flag octet has the
// same bits as LE Fire, with two differences. Bit 6: the location is in coordinates of the target,
// not of the world. Bit 7: a second flag octet follows. The bits of the second: munition
// orientation, event ID. The munition's orientation has three numbers of 16 bits in the 2012 text
// (the schema of opendis7 marks that as odd), but of 8 bits in KDIS, as in a TSPI. Each number is
// read as 16 bits if the PDU is long enough for them, else as 8.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/live_entity/live_entity.hpp"

namespace reckon::pdu {

struct LeDetonation {
  static constexpr PduType kPduType = PduType::le_detonation;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::live_entity;

  PduHeader header = header_of<LeDetonation>();
  LiveEntityId firing_live_entity_id;
  std::uint8_t flags_1 = 0;
  std::uint8_t flags_2 = 0;  ///< bit 7 of flags_1
  LiveShot shot;
  RelativeWorldCoordinates world_location;  ///< bit 6 not set
  LiveVector<std::int16_t> velocity;        ///< [dm/s]
  /// Bit 0 of flags_2; three octets on the wire if `short_orientation`.
  LiveEulerAngles<std::int16_t> munition_orientation;
  LiveEulerAngles<std::int8_t> short_munition_orientation;
  LiveVector<std::int16_t> entity_location;  ///< bit 6
  std::uint8_t detonation_result = 0;
  bool short_orientation = false;  ///< not on the wire: an orientation has 8 bits a number

  [[nodiscard]] constexpr std::uint8_t more_flags() const noexcept {
    return has_flag(flags_1, 7) ? flags_2 : std::uint8_t{0};
  }
  /// Octets of a PDU with these flags; an orientation, if present, counts with 16 bits a number.
  [[nodiscard]] std::size_t full_size() const noexcept;
};

template <typename Visitor, Is<LeDetonation> Pdu>
constexpr void fields(Visitor& visitor, Pdu& pdu) {
  visitor("header", pdu.header);
  visitor("firing_live_entity_id", pdu.firing_live_entity_id);
  visitor("detonation_flags_1", pdu.flags_1);
  when(has_flag(pdu.flags_1, 7), visitor, "detonation_flags_2", pdu.flags_2);
  const std::uint8_t more = pdu.more_flags();
  const bool in_entity_axes = has_flag(pdu.flags_1, 6);
  if constexpr (!std::is_const_v<Pdu>)
    pdu.short_orientation = has_flag(more, 0) && pdu.header.length < pdu.full_size();
  id_fields(visitor, pdu.shot, pdu.flags_1, has_flag(more, 1));
  when(!in_entity_axes, visitor, "world_location", pdu.world_location);
  when(true, visitor, "velocity", pdu.velocity);
  const bool oriented = has_flag(more, 0);
  when(oriented && !pdu.short_orientation, visitor, "munition_orientation",
       pdu.munition_orientation);
  when(oriented && pdu.short_orientation, visitor, "munition_orientation",
       pdu.short_munition_orientation);
  munition_fields(visitor, pdu.shot, pdu.flags_1);
  when(in_entity_axes, visitor, "entity_location", pdu.entity_location);
  when(true, visitor, "detonation_result", pdu.detonation_result);
}
static_assert(kFixedSize<LeDetonation> == 17);

inline std::size_t LeDetonation::full_size() const noexcept {
  LeDetonation wide = *this;
  wide.short_orientation = false;
  WireSize size;
  fields(size, std::as_const(wide));
  return kFixedSize<LeDetonation> + size.variable();
}

}  // namespace reckon::pdu
