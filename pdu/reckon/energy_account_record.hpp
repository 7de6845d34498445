// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One side's account of the energy it passed to a counterpart in contact, carried as a record of
// the Attribute PDU (24 octets). Running totals, so that a lost or doubled PDU makes no energy.
#pragma once

#include <cstdint>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::pdu {

inline constexpr std::uint32_t kEnergyAccountRecordType = 0x48415002;  ///< "HAP", 2
inline constexpr std::uint16_t kEnergyAccountRecordLength = 24;        ///< octets

struct EnergyAccountRecord {
  static constexpr std::uint32_t kType = kEnergyAccountRecordType;
  static constexpr std::uint16_t kLength = kEnergyAccountRecordLength;

  std::uint32_t type = kType;
  std::uint16_t length = kLength;
  EntityId counterpart;  ///< who may take it
  double given = 0.0;    ///< total given to the counterpart since contact began, never falls [J]
  float need = 0.0F;     ///< what this side's gate is short of now [J]
};

template <typename Visitor, Is<EnergyAccountRecord> Record>
constexpr void fields(Visitor& visitor, Record& record) {
  visitor("record_type", record.type);
  visitor("record_length", record.length);
  visitor("counterpart", record.counterpart);
  visitor("given", record.given);
  visitor("need", record.need);
}
static_assert(kFixedSize<EnergyAccountRecord> == kEnergyAccountRecordLength);

}  // namespace reckon::pdu
