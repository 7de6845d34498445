// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Coefficients of an entity's force model in one record of the Attribute PDU (72 octets), so that
// every peer can render the contact force of a remote entity locally.
#pragma once

#include <cstdint>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::pdu {

inline constexpr std::uint32_t kHapticRecordType = 0x48415001;  ///< "HAP", 1
inline constexpr std::uint16_t kHapticRecordLength = 72;        ///< octets
inline constexpr std::uint8_t kHapticRecordVersion = 1;

/// Positions and directions are in body axes of the entity in the record set (frame B). The wire
/// may have any float, NaN too: check before use (deadreckon does).
struct HapticRecord {
  static constexpr std::uint32_t kType = kHapticRecordType;
  static constexpr std::uint16_t kLength = kHapticRecordLength;
  static constexpr std::uint8_t kVersion = kHapticRecordVersion;

  std::uint32_t type = kType;
  std::uint16_t length = kLength;
  std::uint8_t version = kVersion;
  ForceModelKind kind = ForceModelKind::none;
  std::uint8_t order = 0;         ///< order of the polynomial or of the reduced model
  std::uint8_t flags = 0;         ///< none in version 1: sent as 0, ignored on reception
  std::uint16_t surface = 0;      ///< surface id in the scene; 0 = not stated
  std::uint16_t validity_ms = 0;  ///< [ms], validity after the Entity State's time
  std::uint16_t grip_stiffness = 0;  ///< [N/m], of the spring that holds `surface`; 0 = not stated
  float k1 = 0.0F;       ///< linear stiffness [N/m]
  float k3 = 0.0F;       ///< cubic stiffness [N/m^3]
  float damping = 0.0F;  ///< [N s/m]
  float mass = 0.0F;     ///< apparent mass [kg]
  Vector3Float point;    ///< contact point or centre [m]
  Vector3Float normal;   ///< outward surface normal, unit length
  float static_friction = 0.0F;
  float kinetic_friction = 0.0F;
  float restitution = 0.0F;  ///< 0 to 1
  float radius = 0.0F;       ///< [m]
};

constexpr void fields(auto& visitor, Is<HapticRecord> auto& record) {
  visitor("record_type", record.type);
  visitor("record_length", record.length);
  visitor("version", record.version);
  visitor("kind", record.kind);
  visitor("order", record.order);
  visitor("flags", record.flags);
  visitor("surface", record.surface);
  visitor("validity_ms", record.validity_ms);
  visitor("grip_stiffness", record.grip_stiffness);
  visitor("k1", record.k1);
  visitor("k3", record.k3);
  visitor("damping", record.damping);
  visitor("mass", record.mass);
  visitor("point", record.point);
  visitor("normal", record.normal);
  visitor("static_friction", record.static_friction);
  visitor("kinetic_friction", record.kinetic_friction);
  visitor("restitution", record.restitution);
  visitor("radius", record.radius);
}
static_assert(kFixedSize<HapticRecord> == kHapticRecordLength);

}  // namespace reckon::pdu
