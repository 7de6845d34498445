// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Bodies whose fields differ between DIS 5 or 6 and DIS 7: the same octets with another version,
// and PDUs of other products with the values that tshark 4.0 shows for them.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "reckon/pdu/pdu_types.hpp"
#include "reckon/pdu/print.hpp"
#include "reckon/tests/pdu/support/pcap_reader.hpp"
#include "reckon/tests/support/reference_data.hpp"
#include "reckon/tests/support/wire_samples.hpp"

namespace reckon::pdu {
namespace {

using Octets = std::vector<std::byte>;

// The JSON of a PDU of `version` that decodes and encodes to the same octets.
template <typename T>
nlohmann::json shown(Octets octets, unsigned version) {
  octets[0] = static_cast<std::byte>(version);
  T pdu;
  EXPECT_EQ(decode(octets, pdu), DecodeError::none);
  Octets back(wire_size(pdu));
  EXPECT_EQ(encode(pdu, back), octets.size());
  EXPECT_EQ(back, octets);
  std::string text;
  TextSink sink(text);
  print_json(pdu, sink);
  return nlohmann::json::parse(text);
}

template <typename T>
nlohmann::json recorded(const char* name) {
  const auto path = test::reference_data() / "dis-captures/real-pdus" / name;
  const auto octets = test::file_octets(path);
  return shown<T>(octets, std::to_integer<unsigned>(octets[0]));
}

TEST(OlderVersions, HaveANomenclatureInTheRadioType) {
  Octets octets = test::sample_octets("transmitter");
  EXPECT_TRUE(shown<Transmitter>(octets, 7).contains("radio_type"));
  octets.resize(104 + 16 + 40);  // without the records of DIS 7
  store_big_endian(octets.data() + 8, static_cast<std::uint16_t>(octets.size()));
  for (const unsigned version : {5U, 6U}) {
    const auto json = shown<Transmitter>(octets, version);
    EXPECT_FALSE(json.contains("radio_type"));
    // Kind at 20, domain, country (2), category, nomenclature version, nomenclature (2).
    EXPECT_EQ(json["radio_entity_type"]["nomenclature_version"],
              std::to_integer<unsigned>(octets[25]));
    EXPECT_EQ(json["radio_entity_type"]["nomenclature"],
              load_big_endian<std::uint16_t>(octets.data() + 26));
  }
}

TEST(OlderVersions, HaveOneJammingModeSequenceInABeam) {
  Octets octets = test::sample_octets("electromagnetic_emission");
  const auto now = shown<ElectromagneticEmission>(octets, 7)["systems"][0]["beams"][0];
  const auto before = shown<ElectromagneticEmission>(octets, 6)["systems"][0]["beams"][0];
  EXPECT_EQ(before["padding"], now["beam_status"]);
  EXPECT_FALSE(before.contains("jamming_technique_kind"));
  // As open-dis 1.3.6 (JavaScript) reads the same octets as DIS 6.
  EXPECT_EQ(before["padding"], 96);
  EXPECT_EQ(before["jamming_mode_sequence"], 1633837924);
  EXPECT_EQ(before["track_jam_targets"], now["track_jam_targets"]);
}

TEST(OlderVersions, HavePaddingAfterTheSystemOfAnIff) {
  const Octets octets = test::sample_octets("iff");
  EXPECT_TRUE(shown<Iff>(octets, 7).contains("system_designator"));
  const auto json = shown<Iff>(octets, 6);
  EXPECT_FALSE(json.contains("system_designator"));
  EXPECT_EQ(json["padding"], 11052);  // as open-dis 1.3.6 reads it
}

TEST(OlderVersions, HaveLinearSegmentsOf56OctetsInWholeMetres) {
  Octets octets = test::sample_octets("linear_object_state");
  octets.resize(40);
  for (int segment = 1; segment <= 2; ++segment) {
    Octets head(44);
    head[0] = static_cast<std::byte>(segment);
    octets.insert(octets.end(), head.begin(), head.end());
    for (const std::byte octet : test::octets_from_hex("0001 0002 0003 ffff 00000000"))
      octets.push_back(octet);
  }
  store_big_endian(octets.data() + 8, static_cast<std::uint16_t>(octets.size()));
  const auto segments = shown<LinearObjectState>(octets, 6)["linear_segments"];
  ASSERT_EQ(segments.size(), 2U);
  EXPECT_EQ(segments[1]["segment_number"], 2);
  EXPECT_EQ(segments[1]["segment_length"], 1);
  EXPECT_EQ(segments[1]["segment_depth"], 65535);

  octets[0] = std::byte{7};
  LinearObjectState pdu;
  EXPECT_EQ(decode(octets, pdu), DecodeError::count) << "DIS 7 has 64 octets a segment";
}

TEST(RecordedRadios, HaveTheModulationParametersShownByTshark) {
  RECKON_NEED_DATA("dis-captures/real-pdus");
  const auto sincgars = recorded<Transmitter>("dis6/TransmitterPdu_CCTTSINCGARS.raw");
  const nlohmann::json wanted{{"frequency_hopping_network_id", 1},
                              {"frequency_set_id", 3},
                              {"frequency_lockout_set_id", 4},
                              {"start_of_message", 1},
                              {"reserved", 5},
                              {"sync_time_offset", 2},
                              {"transmission_security_key", 6},
                              {"clear_channel", 1},
                              {"padding", 0}};
  EXPECT_EQ(sincgars["modulation_parameters"], wanted);
  EXPECT_EQ(sincgars["radio_entity_type"]["category"], 1);

  const auto jtids = recorded<Transmitter>("dis6/TransmitterPdu_JtidsMids.raw");
  const nlohmann::json modes{{"time_slot_allocation_mode", 1},
                             {"transmitting_terminal_primary_mode", 1},
                             {"transmitting_terminal_secondary_mode", 1},
                             {"synchronization_state", 1},
                             {"network_synchronization_id", 1}};
  EXPECT_EQ(jtids["modulation_parameters"], modes);
  EXPECT_EQ(jtids["radio_entity_type"]["nomenclature_version"], 3);

  const auto have_quick = recorded<Transmitter>("dis6/TransmitterPdu-HAVEQUICK.raw");
  EXPECT_EQ(have_quick["modulation_parameters"]["mwod_index"], 301);
  EXPECT_EQ(have_quick["modulation_parameters"]["time_of_day"], 1);
}

TEST(RecordedRadios, HaveABeamWithAnglesAndField) {
  RECKON_NEED_DATA("dis-captures/real-pdus");
  for (const char* name : {"dis6/TransmitterPdu_AntennaPattern_Beam.raw",
                           "dis7/TransmitterPdu_VariableTransmitterParameters.raw"}) {
    const auto beam = recorded<Transmitter>(name)["antenna_pattern"];
    // The recording has distinct numbers.
    EXPECT_EQ(beam["beam_direction"]["phi"], 3.0) << name;
    EXPECT_EQ(beam["azimuth_beamwidth"], 55.5) << name;
    EXPECT_EQ(beam["reference_system"], 2) << name;
    EXPECT_EQ(beam["ez"], 52.5) << name;
    EXPECT_EQ(beam["phase"], 51.5) << name;
  }
  // Spherical harmonics are kept as octets.
  const auto other = recorded<Transmitter>("dis6/TransmitterPdu_AntennaPattern_Spherical.raw");
  EXPECT_TRUE(other["antenna_pattern"].is_string());
}

TEST(RecordedIff, HasTheSecondLayerOfItsSender) {
  RECKON_NEED_DATA("dis-captures/real-pdus");
  const auto layers = recorded<Iff>("dis7/IFFPdu.raw")["layers"];
  ASSERT_EQ(layers.size(), 1U);
  EXPECT_EQ(layers[0]["beam_azimuth_center"], 56.0);
  EXPECT_EQ(layers[0]["beam_sweep_sync"], 59.0);
  ASSERT_EQ(layers[0]["fundamental_parameters"].size(), 2U);
  EXPECT_EQ(layers[0]["fundamental_parameters"][1]["burst_length"], 6);
}

TEST(RecordedAggregates, HaveSilentSystemsAndDatums) {
  RECKON_NEED_DATA("dis-captures/real-pdus");
  const auto whole = recorded<AggregateState>("dis6/AggregateStatePduVrForces.raw");
  EXPECT_EQ(whole["number_of_variable_datum_records"], 5);
  EXPECT_EQ(whole["variable_datum_records"][4]["variable_datum_value"], "4c696e6500");
}

TEST(RecordedAggregates, KeepDatumsOfAWrongLengthAsOctets) {
  RECKON_NEED_DATA("dis-captures/real-pdus");
  const auto json = recorded<AggregateState>("dis6/AggregateStatePduJCATS.raw");
  EXPECT_FALSE(json.contains("variable_datum_records"));
  EXPECT_EQ(json["further_octets"].get<std::string>().substr(0, 16), "00000001000f3f93");
}

}  // namespace
}  // namespace reckon::pdu
