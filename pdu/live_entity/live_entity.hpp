// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Common records of the live entity PDUs (types 46 to 50, IEEE 1278.1-2012 clause 9). They are
// short for radio links: IDs have 4 octets, and flag octets switch fields on and off. Order, sizes
// and flags follow two public sources: the schema of opendis7, which follows the 2012 text, and
// KDIS. Differences between the sources are noted in the C++ header of the PDU. Fixed-point numbers
// are kept as integers, because neither source is sure of their binary point. Octet 10 of these
// PDUs is a subprotocol number (UID 417), not a status.
#pragma once

#include <cstdint>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::pdu {

/// Whether bit `bit` (0 is the lowest) of a flag octet is set.
[[nodiscard]] constexpr bool has_flag(std::uint8_t flags, unsigned bit) noexcept {
  return ((flags >> bit) & 1U) != 0;
}

/// One running live simulation.
struct LiveSimulationAddress {
  std::uint8_t site = 0;
  std::uint8_t application = 0;
};

/// Identifier of a live entity.
struct LiveEntityId {
  std::uint8_t site = 0;
  std::uint8_t application = 0;
  std::uint16_t entity = 0;
};

/// A point relative to an agreed reference point [dm].
struct RelativeWorldCoordinates {
  std::uint16_t reference_point = 0;
  std::int16_t delta_x = 0;
  std::int16_t delta_y = 0;
  std::int16_t delta_z = 0;
};

/// Three fixed-point numbers; the unit depends on the field.
template <typename T>
struct LiveVector {
  T x = 0;
  T y = 0;
  T z = 0;
};

/// Three fixed-point angles.
template <typename T>
struct LiveEulerAngles {
  T psi = 0;
  T theta = 0;
  T phi = 0;
};

/// Fields of LE Fire and LE Detonation whose flag bits are the same in both PDUs.
struct LiveShot {
  LiveEntityId target_id;                  ///< bit 0
  LiveSimulationAddress munition_address;  ///< bits 2 and 1; else the firing entity's address
  std::uint16_t munition_number = 0;       ///< bit 2: entity number of the munition
  LiveSimulationAddress event_address;     ///< bit 3; else the firing entity's address
  std::uint16_t event_number = 0;
  EntityType munition_type;
  std::uint16_t warhead = 0;   ///< bit 4
  std::uint16_t fuse = 0;      ///< bit 4
  std::uint16_t quantity = 0;  ///< bit 5
  std::uint16_t rate = 0;      ///< bit 5
};

/// Target, munition and event, according to `flags`; `event`: the PDU has an event.
constexpr void id_fields(auto& visitor, Is<LiveShot> auto& shot, std::uint8_t flags, bool event) {
  when(has_flag(flags, 0), visitor, "target_live_entity_id", shot.target_id);
  const bool munition = has_flag(flags, 2);
  when(munition && has_flag(flags, 1), visitor, "munition_simulation_address",
       shot.munition_address);
  when(munition, visitor, "munition_entity_number", shot.munition_number);
  when(event && has_flag(flags, 3), visitor, "event_simulation_address", shot.event_address);
  when(event, visitor, "event_number", shot.event_number);
}

/// The munition descriptor, according to `flags`.
constexpr void munition_fields(auto& visitor, Is<LiveShot> auto& shot, std::uint8_t flags) {
  when(true, visitor, "munition_type", shot.munition_type);
  when(has_flag(flags, 4), visitor, "warhead", shot.warhead);
  when(has_flag(flags, 4), visitor, "fuse", shot.fuse);
  when(has_flag(flags, 5), visitor, "quantity", shot.quantity);
  when(has_flag(flags, 5), visitor, "rate", shot.rate);
}

}  // namespace reckon::pdu
