// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Account of the energy that one side passed to a counterpart in contact: a record of the Attribute
// PDU (24 octets). Energies are running totals, so that a lost or duplicated PDU creates no energy.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::pdu {

inline constexpr std::uint32_t kEnergyAccountRecordType = 0x48415003;  ///< "HAP", 3
inline constexpr std::uint16_t kEnergyAccountRecordLength = 24;        ///< octets

struct EnergyAccountRecord {
  static constexpr std::uint32_t kType = kEnergyAccountRecordType;
  static constexpr std::uint16_t kLength = kEnergyAccountRecordLength;

  std::uint32_t type = kType;
  std::uint16_t length = kLength;
  EntityId counterpart;  ///< the receiver of the energy; entity 0 of the scene: all its bodies
  /// [J], total given to the counterpart since contact began; never falls. For all bodies: energy
  /// that the hand has put into them since its start, minus what came back.
  double given = 0.0;
  /// Energy that this side lacks for its whole force, none of it booked as a spring [uJ]; 65,535
  /// also stands for more.
  std::uint16_t need = 0;
  /// Energy that this side lacks for its springs if they release normally [uJ].
  std::uint16_t spring_need = 0;
};

constexpr void fields(auto& visitor, Is<EnergyAccountRecord> auto& record) {
  visitor("record_type", record.type);
  visitor("record_length", record.length);
  visitor("counterpart", record.counterpart);
  visitor("given", record.given);
  visitor("need", record.need);
  visitor("spring_need", record.spring_need);
}
/// Joules in the unit of the record: rounded and limited to its range; NaN becomes 0.
[[nodiscard]] inline std::uint16_t to_microjoules(double joules) noexcept {
  return joules > 0 ? static_cast<std::uint16_t>(std::min(65535.0, std::round(1e6 * joules))) : 0;
}
[[nodiscard]] constexpr double from_microjoules(std::uint16_t microjoules) noexcept {
  return 1e-6 * microjoules;
}

static_assert(kFixedSize<EnergyAccountRecord> == kEnergyAccountRecordLength);

}  // namespace reckon::pdu
