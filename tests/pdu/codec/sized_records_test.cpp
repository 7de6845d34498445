// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Records with a length field of their own, inside their PDUs.
#include "reckon/pdu/codec/sized_records.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "reckon/pdu/emission/electromagnetic_emission.hpp"
#include "reckon/pdu/emission/iff.hpp"
#include "reckon/pdu/environment/environmental_process.hpp"
#include "reckon/pdu/finite.hpp"
#include "reckon/pdu/management/record_r.hpp"
#include "reckon/pdu/print.hpp"
#include "reckon/pdu/radio/signal.hpp"
#include "reckon/pdu/radio/transmitter.hpp"
#include "reckon/tests/support/wire_samples.hpp"

namespace reckon::pdu::sized_records_test {
namespace {

using Octets = std::vector<std::byte>;

template <typename T>
DecodeError error_of(const Octets& octets) {
  T pdu;
  return decode(octets, pdu);
}

template <typename T>
Octets encoded(const T& pdu) {
  Octets octets(wire_size(pdu));
  EXPECT_EQ(encode(pdu, octets), octets.size());
  return octets;
}

// The sample has a system of 33 x 4 octets at offset 28, with beams at 48 (one target) and 108,
// then a system without beams.
constexpr std::size_t kSystem = 28;
constexpr std::size_t kBeam = 48;

TEST(EmitterSystems, ContainBeamsAndBeamsContainTargets) {
  const Octets octets = test::sample_octets("electromagnetic_emission");
  ElectromagneticEmission pdu;
  ASSERT_EQ(decode(octets, pdu), DecodeError::none);
  std::vector<std::size_t> targets;
  for (const auto& [system, body] : pdu.systems.records()) {
    const SizedRecords<EmitterBeam, std::uint8_t> beams{system.number_of_beams, body};
    for (const auto& beam : beams.records()) targets.push_back(beam.head.number_of_targets);
  }
  EXPECT_EQ(targets, (std::vector<std::size_t>{1, 0}));
}

TEST(EmitterSystems, WithoutLengthTakeTheLengthOfTheirParts) {
  Octets octets = test::sample_octets("electromagnetic_emission");
  octets[kSystem] = std::byte{0};
  octets[kBeam] = std::byte{0};
  ElectromagneticEmission pdu;
  ASSERT_EQ(decode(octets, pdu), DecodeError::none);
  EXPECT_EQ(encoded(pdu), octets);
}

TEST(EmitterSystems, RefuseALengthThatCutsABeam) {
  const Octets good = test::sample_octets("electromagnetic_emission");
  for (const unsigned length : {1U, 4U, 5U, 32U, 34U, 255U}) {
    Octets octets = good;
    octets[kSystem] = std::byte(length);
    EXPECT_NE(error_of<ElectromagneticEmission>(octets), DecodeError::none) << length;
  }
}

TEST(EmitterBeams, RefuseALengthThatCutsTheirTargets) {
  Octets octets = test::sample_octets("electromagnetic_emission");
  octets[kBeam] = std::byte{14};
  EXPECT_EQ(error_of<ElectromagneticEmission>(octets), DecodeError::record);
}

TEST(EmitterBeams, AreSearchedForValuesThatAreNotFinite) {
  Octets octets = test::sample_octets("electromagnetic_emission");
  ElectromagneticEmission pdu;
  ASSERT_EQ(decode(octets, pdu), DecodeError::none);
  EXPECT_TRUE(all_finite(pdu));
  store_big_endian(octets.data() + kBeam + 4, std::numeric_limits<float>::quiet_NaN());
  ASSERT_EQ(decode(octets, pdu), DecodeError::none);
  EXPECT_EQ(first_not_finite(pdu), "beams");
}

TEST(EnvironmentRecords, CountTheirHeaderButNotTheirPadding) {
  const Octets octets = test::sample_octets("environmental_process");
  EnvironmentalProcess pdu;
  ASSERT_EQ(decode(octets, pdu), DecodeError::none);
  std::vector<std::size_t> bodies;
  for (const auto& record : pdu.environment_records.records()) bodies.push_back(record.body.size());
  // The first has 256 bits including the header. The last has 100 bits: 13 octets, padded to 16.
  EXPECT_EQ(bodies, (std::vector<std::size_t>{24, 48, 32, 48, 56, 8}));
}

TEST(EnvironmentRecords, ShorterThanTheirHeaderAreRefused) {
  Octets octets = test::sample_octets("environmental_process");
  store_big_endian(octets.data() + 36, std::uint16_t{0});
  EXPECT_EQ(error_of<EnvironmentalProcess>(octets), DecodeError::record);
}

TEST(IffLayers, ExtendToTheEndOfThePdu) {
  const Octets octets = test::sample_octets("iff");
  Iff pdu;
  ASSERT_EQ(decode(octets, pdu), DecodeError::none);
  std::vector<unsigned> layers;
  for (const auto& layer : pdu.layers.records()) layers.push_back(layer.head.layer_number);
  EXPECT_EQ(layers, (std::vector<unsigned>{2, 3, 4, 4, 5}));
}

TEST(IffLayers, InvalidModeSLayersStayOctets) {
  const auto shown = [](std::size_t size, std::uint8_t records) {
    Octets layer(size);
    layer[0] = std::byte{4};
    layer[3] = static_cast<std::byte>(size);
    if (size >= 36) layer[35] = static_cast<std::byte>(records);
    Iff pdu;
    pdu.layers.bytes = layer;
    std::string text;
    TextSink sink(text);
    print_json(pdu, sink);
    return text;
  };
  EXPECT_NE(shown(36, 0).find("\"levels_present\":0"), std::string::npos);
  EXPECT_EQ(shown(36, 1).find("levels_present"), std::string::npos) << "a record is missing";
  EXPECT_EQ(shown(20, 0).find("levels_present"), std::string::npos) << "too short";
}

TEST(IffLayers, OfZeroLengthAreRefusedWithoutALoop) {
  Octets octets = test::sample_octets("iff");
  store_big_endian(octets.data() + 62, std::uint16_t{0});
  EXPECT_EQ(error_of<Iff>(octets), DecodeError::record);
}

TEST(RecordSets, OfHugeBitCountAreRefusedAtOnce) {
  Octets octets = test::sample_octets("record_r");
  store_big_endian(octets.data() + 40 + 12, std::uint32_t{0xFFFFFFFF});
  EXPECT_EQ(error_of<RecordR>(octets), DecodeError::record);
}

TEST(SignalData, HasABitLengthAndOptionalFinalPadding) {
  Octets octets = test::sample_octets("signal");
  Signal pdu;
  ASSERT_EQ(decode(octets, pdu), DecodeError::none);
  EXPECT_EQ(pdu.data.count, 71);
  EXPECT_EQ(pdu.data.value().size(), 9U);
  EXPECT_EQ(pdu.data.bytes.size(), 12U);

  octets.resize(octets.size() - 3);
  store_big_endian(octets.data() + 8, static_cast<std::uint16_t>(octets.size()));
  ASSERT_EQ(decode(octets, pdu), DecodeError::none);
  EXPECT_EQ(encoded(pdu), octets);
}

TEST(Transmitter, HasVariableParametersInVersion7Only) {
  Octets octets = test::sample_octets("transmitter");
  Transmitter pdu;
  ASSERT_EQ(decode(octets, pdu), DecodeError::none);
  EXPECT_EQ(pdu.variable_transmitter_parameters.count, 2);
  EXPECT_FALSE(pdu.variable_transmitter_parameters.bytes.empty());

  // In version 6 these two octets are padding with any value.
  octets.resize(104 + 16 + 40);
  octets[0] = std::byte{6};
  store_big_endian(octets.data() + 8, static_cast<std::uint16_t>(octets.size()));
  store_big_endian(octets.data() + 30, std::uint16_t{0xFFFF});
  ASSERT_EQ(decode(octets, pdu), DecodeError::none);
  EXPECT_TRUE(pdu.variable_transmitter_parameters.bytes.empty());
  EXPECT_EQ(encoded(pdu), octets);
}

}  // namespace
}  // namespace reckon::pdu::sized_records_test
