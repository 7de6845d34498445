// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Electromagnetic Emission PDUs with systems and beams of the test's choice.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "reckon/pdu/emission/electromagnetic_emission.hpp"

namespace reckon::test {

/// A beam, with its targets 2:1:100, 2:1:101, ..
struct SampleBeam {
  std::uint8_t number = 1;
  std::uint8_t targets = 0;
  std::uint8_t status = 0;  ///< 1: deactivated
  float frequency = 9.4e9F;
};
struct SampleSystem {
  std::uint8_t number = 1;
  std::vector<SampleBeam> beams = {};
};
/// Three systems with 0, 2 and 1 beams, which have 1, 0 and 2 targets.
inline const std::vector<SampleSystem> kThreeSystems{{1}, {2, {{1, 1}, {2, 0}}}, {3, {{1, 2}}}};

template <typename Record>
void append_record(std::vector<std::byte>& out, const Record& record) {
  const std::size_t begin = out.size();
  out.resize(begin + pdu::kFixedSize<Record>);
  static_cast<void>(store_record(record, std::span(out).subspan(begin)));
}

inline void append_beam(std::vector<std::byte>& out, const SampleBeam& sample) {
  pdu::EmitterBeam beam;
  static_cast<void>(beam.claim(std::size_t{sample.targets} * 8));
  beam.beam_number = sample.number;
  beam.frequency = sample.frequency;
  beam.beam_function = 6;
  beam.jamming.beam_status = sample.status;
  append_record(out, beam);
  for (std::uint16_t i = 0; i < sample.targets; ++i)
    append_record(out, pdu::TrackJamTarget{{2, 1, static_cast<std::uint16_t>(100 + i)}, 10, 2});
}

/// The octets of the PDU.  @param changes 1: changed data, else all
inline std::vector<std::byte> emission_pdu(const pdu::EntityId& entity,
                                           const std::vector<SampleSystem>& systems,
                                           std::uint8_t changes = 0, std::uint8_t version = 7) {
  std::vector<std::byte> octets;
  for (const SampleSystem& sample : systems) {
    std::vector<std::byte> beams;
    for (const SampleBeam& beam : sample.beams) append_beam(beams, beam);
    pdu::EmitterSystem system;
    static_cast<void>(system.claim(beams.size()));
    if (20 + beams.size() > 4 * 255) system.system_data_length = 0;  // too long for the field
    system.number_of_beams = static_cast<std::uint8_t>(sample.beams.size());
    system.name = static_cast<std::uint16_t>(1000 + sample.number);
    system.function = 1;
    system.number = sample.number;
    append_record(octets, system);
    octets.insert(octets.end(), beams.begin(), beams.end());
  }
  pdu::ElectromagneticEmission pdu;
  pdu.header.protocol_version = version;
  pdu.header.exercise_id = 1;
  pdu.emitting_entity_id = entity;
  pdu.state_update_indicator = changes;
  const auto count = static_cast<std::uint8_t>(systems.size());
  pdu.systems = {count, octets};
  pdu.dis6_systems = {count, octets};
  std::vector<std::byte> out(wire_size(pdu));
  static_cast<void>(encode(pdu, out));
  return out;
}

}  // namespace reckon::test
