// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Common records of emission PDUs: the head of an emitting system and the scan of a beam. The heads
// of radars (Electromagnetic Emission PDU) and sonars (Underwater Acoustic PDU) differ only in
// names. Radars and IFF systems share the scan.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/codec/sized_records.hpp"

namespace reckon::pdu {

/// Scan of a beam; its fields are direct fields of the record that contains it.
struct BeamData {
  static constexpr bool kInlined = true;
  float beam_azimuth_center = 0.0F;    ///< [rad]
  float beam_azimuth_sweep = 0.0F;     ///< half the sweep [rad]
  float beam_elevation_center = 0.0F;  ///< [rad]
  float beam_elevation_sweep = 0.0F;   ///< half the sweep [rad]
  float beam_sweep_sync = 0.0F;        ///< [%]
};

/// Head of a system; its beams follow. `Beam` has the names that differ: kSystemName,
/// kSystemFunction, kSystemNumber.
template <typename BeamType>
struct EmissionSystem {
  using Beam = BeamType;
  std::uint8_t system_data_length = 0;  ///< head and beams [4 octets]; 0 = too long for the field
  std::uint8_t number_of_beams = 0;
  std::uint16_t padding = 0;
  std::uint16_t name = 0;
  std::uint8_t function = 0;
  std::uint8_t number = 0;
  Vector3Float location;  ///< body axes of the emitting entity [m]

  [[nodiscard]] WalkResult extent(std::span<const std::byte> behind) const noexcept {
    return extent_by_parts<Beam>(system_data_length, 20, number_of_beams, behind);
  }
  [[nodiscard]] std::size_t claim(std::size_t octets) noexcept {
    number_of_beams = 0;
    system_data_length = static_cast<std::uint8_t>(5 + octets / 4);
    return octets / 4 * 4;
  }
};

template <typename Visitor, typename Record>
requires Is<Record, EmissionSystem<typename Record::Beam>>
constexpr void fields(Visitor& visitor, Record& record) {
  visitor("system_data_length", record.system_data_length);
  visitor("number_of_beams", record.number_of_beams);
  visitor("padding", record.padding);
  visitor(Record::Beam::kSystemName, record.name);
  visitor(Record::Beam::kSystemFunction, record.function);
  visitor(Record::Beam::kSystemNumber, record.number);
  visitor("location", record.location);
}

template <typename Visitor, typename Beam>
void parts(Visitor& visitor, const EmissionSystem<Beam>& system, std::span<const std::byte> body) {
  visitor.walked("beams", SizedRecords<Beam, std::uint8_t>{system.number_of_beams, body});
}

}  // namespace reckon::pdu
