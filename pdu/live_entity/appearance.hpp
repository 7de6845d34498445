// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Appearance PDU (type 47): type and appearance of a live entity. The bits of its first flag octet,
// from the lowest: force, type, alternative type, marking, capabilities, visual and infrared
// appearance, second flag octet. The bits of the second: electromagnetic and acoustic appearance.
// The schema of opendis7 counts both octets as one field of 16 bits that is always present. Here
// the second octet is read only if bit 7 is set, as in KDIS and in LE Detonation.
#pragma once

#include <cstdint>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/entity/entity_state.hpp"
#include "reckon/pdu/live_entity/live_entity.hpp"

namespace reckon::pdu {

struct Appearance {
  static constexpr PduType kPduType = PduType::appearance;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::live_entity;

  PduHeader header = header_of<Appearance>();
  LiveEntityId live_entity_id;
  std::uint8_t flags_1 = 0;
  std::uint8_t flags_2 = 0;                      ///< bit 7 of flags_1
  ForceId force_id = ForceId::other;             ///< bit 0
  EntityType entity_type;                        ///< bit 1
  EntityType alternative_entity_type;            ///< bit 2
  EntityMarking marking;                         ///< bit 3
  std::uint32_t capabilities = 0;                ///< bit 4
  std::uint32_t visual_appearance = 0;           ///< bit 5
  std::uint32_t infrared_appearance = 0;         ///< bit 6
  std::uint32_t electromagnetic_appearance = 0;  ///< bit 0 of flags_2
  std::uint32_t acoustic_appearance = 0;         ///< bit 1 of flags_2
};

constexpr void fields(auto& visitor, Is<Appearance> auto& pdu) {
  visitor("header", pdu.header);
  visitor("live_entity_id", pdu.live_entity_id);
  visitor("appearance_flags_1", pdu.flags_1);
  when(has_flag(pdu.flags_1, 7), visitor, "appearance_flags_2", pdu.flags_2);
  when(has_flag(pdu.flags_1, 0), visitor, "force_id", pdu.force_id);
  when(has_flag(pdu.flags_1, 1), visitor, "entity_type", pdu.entity_type);
  when(has_flag(pdu.flags_1, 2), visitor, "alternate_entity_type", pdu.alternative_entity_type);
  when(has_flag(pdu.flags_1, 3), visitor, "entity_marking", pdu.marking);
  when(has_flag(pdu.flags_1, 4), visitor, "capabilities", pdu.capabilities);
  when(has_flag(pdu.flags_1, 5), visitor, "visual_appearance", pdu.visual_appearance);
  when(has_flag(pdu.flags_1, 6), visitor, "infrared_appearance", pdu.infrared_appearance);
  const std::uint8_t more = has_flag(pdu.flags_1, 7) ? pdu.flags_2 : std::uint8_t{0};
  when(has_flag(more, 0), visitor, "electromagnetic_appearance", pdu.electromagnetic_appearance);
  when(has_flag(more, 1), visitor, "acoustic_appearance", pdu.acoustic_appearance);
}
static_assert(kFixedSize<Appearance> == 17);

}  // namespace reckon::pdu
