// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Records that many PDUs share, as in IEEE 1278.1-2012 clause 6.2, in host form.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "reckon/pdu/codec/enumerations.hpp"
#include "reckon/pdu/codec/field_table.hpp"

namespace reckon::pdu {

/// Site and application: one simulation application.
struct SimulationAddress {
  std::uint16_t site = 0;
  std::uint16_t application = 0;

  friend constexpr auto operator<=>(const SimulationAddress&, const SimulationAddress&) = default;
};

/// Entity identifier, unique in an exercise. Written "site:application:entity".
struct EntityId {
  std::uint16_t site = 0;
  std::uint16_t application = 0;
  std::uint16_t entity = 0;

  [[nodiscard]] constexpr SimulationAddress simulation() const { return {site, application}; }
  /// All three numbers in the lower 48 bits; unique for each ID.
  [[nodiscard]] constexpr std::uint64_t key() const noexcept {
    return std::uint64_t{site} << 32 | std::uint64_t{application} << 16 | entity;
  }
  friend constexpr auto operator<=>(const EntityId&, const EntityId&) = default;
};

/// Site 65535, application 65535, entity 65535: every entity of the exercise.
inline constexpr EntityId kAllEntities{0xFFFF, 0xFFFF, 0xFFFF};

/// Links the PDUs about one event; numbered by the issuing simulation.
struct EventId {
  std::uint16_t site = 0;
  std::uint16_t application = 0;
  std::uint16_t event = 0;

  friend constexpr auto operator<=>(const EventId&, const EventId&) = default;
};

/// Type of an entity (SISO-REF-010).
struct EntityType {
  EntityKind kind = EntityKind::other;
  EntityDomain domain = EntityDomain::other;
  std::uint16_t country = 0;
  std::uint8_t category = 0;
  std::uint8_t subcategory = 0;
  std::uint8_t specific = 0;
  std::uint8_t extra = 0;

  /// Its parts, in the order of their declaration.
  [[nodiscard]] constexpr std::array<std::uint16_t, 7> numbers() const noexcept {
    return {static_cast<std::uint16_t>(kind), static_cast<std::uint16_t>(domain), country, category,
            subcategory, specific, extra};
  }
  friend constexpr auto operator<=>(const EntityType&, const EntityType&) = default;
};

/// A point in geocentric ECEF axes of WGS84 (frame W) [m].
struct WorldCoordinates {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;

  friend constexpr bool operator==(const WorldCoordinates&, const WorldCoordinates&) = default;
};

/// Three 32-bit floats; unit and frame depend on the field.
struct Vector3Float {
  float x = 0.0F;
  float y = 0.0F;
  float z = 0.0F;

  friend constexpr bool operator==(const Vector3Float&, const Vector3Float&) = default;
};

/// Rotations psi about z, theta about the new y, phi about the new x, from W to body axes [rad].
struct EulerAngles {
  float psi = 0.0F;
  float theta = 0.0F;
  float phi = 0.0F;

  friend constexpr bool operator==(const EulerAngles&, const EulerAngles&) = default;
};

/// Hours since 1970-01-01T00:00Z (or a relative origin), and the part of the hour in timestamp
/// units.
struct ClockTime {
  std::int32_t hour = 0;
  std::uint32_t time_past_hour = 0;

  friend constexpr bool operator==(const ClockTime&, const ClockTime&) = default;
};

}  // namespace reckon::pdu

/// 48 bits mixed to 64 (the finaliser of MurmurHash3), so that dense ids spread over a table.
template <>
struct std::hash<reckon::pdu::EntityId> {
  [[nodiscard]] std::size_t operator()(const reckon::pdu::EntityId& id) const noexcept {
    std::uint64_t bits = id.key();
    bits = (bits ^ (bits >> 33)) * 0xff51afd7ed558ccdULL;
    bits = (bits ^ (bits >> 33)) * 0xc4ceb9fe1a85ec53ULL;
    return static_cast<std::size_t>(bits ^ (bits >> 33));
  }
};
