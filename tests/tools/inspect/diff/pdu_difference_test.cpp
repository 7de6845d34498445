// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Differing fields of two PDUs: names and octets, compared with the byte tables of the wire format.
#include "reckon/tools/inspect/diff/pdu_difference.hpp"

#include <gmock/gmock.h>

#include <array>
#include <random>
#include <string>

#include "reckon/pdu/emission/electromagnetic_emission.hpp"
#include "reckon/pdu/management/comment.hpp"
#include "reckon/tests/tools/support/haptic_traffic.hpp"

namespace reckon::tools {
namespace {

using test::Octets;

TEST(PduDifferences, NameFieldsAndOffsetsOfTheByteTable) {
  struct Row {
    std::size_t offset;
    std::size_t size;
    const char* field;
  };
  constexpr std::array<Row, 17> kTable{
      {{1, 1, "header.exercise_id"},
       {4, 4, "header.timestamp"},
       {12, 2, "entity_id.site"},
       {16, 2, "entity_id.entity"},
       {18, 1, "force_id"},
       {22, 2, "entity_type.country"},
       {35, 1, "alternate_entity_type.extra"},
       {36, 4, "entity_linear_velocity.x"},
       {48, 8, "entity_location.x"},
       {64, 8, "entity_location.z"},
       {72, 4, "entity_orientation.psi"},
       {84, 4, "entity_appearance"},
       {88, 1, "dead_reckoning_parameters.dead_reckoning_algorithm"},
       {89, 15, "dead_reckoning_parameters.other_parameters"},
       {124, 4, "dead_reckoning_parameters.entity_angular_velocity.z"},
       {129, 11, "entity_marking.entity_marking_string"},
       {140, 4, "capabilities"}}};
  Octets a;
  test::append_pdu(a, test::state_of({.entity = 1}));
  for (const Row& row : kTable) {
    for (std::size_t octet = row.offset; octet < row.offset + row.size; ++octet) {
      Octets b = a;
      b[octet] ^= std::byte{0x40};
      const auto found = pdu_differences(a, b);
      ASSERT_EQ(found.size(), 1U) << octet;
      EXPECT_EQ(found[0].field, row.field) << octet;
      EXPECT_EQ(found[0].offset, row.offset) << octet;
      EXPECT_NE(found[0].a, found[0].b) << octet;
    }
  }
}

TEST(PduDifferences, NumberTheRecordsBehindTheFixedPart) {
  pdu::EntityState state;
  std::array<std::byte, 48> parameters{};  // three articulated parts
  state.variable_parameters = parameters;
  Octets a;
  test::append_pdu(a, state);
  for (std::size_t octet = 144; octet < a.size(); ++octet) {
    Octets b = a;
    b[octet] ^= std::byte{1};
    const auto found = pdu_differences(a, b);
    ASSERT_EQ(found.size(), 1U) << octet;
    const std::string record = "variable_parameters[" + std::to_string((octet - 144) / 16) + "].";
    EXPECT_THAT(found[0].field, ::testing::StartsWith(record)) << octet;
    EXPECT_LE(found[0].offset, octet);
    EXPECT_GT(found[0].offset + 8, octet);
  }
}

TEST(PduDifferences, GoIntoRecordsOfVaryingSize) {
  Octets a;
  pdu::Comment comment;
  std::array<std::byte, 64> buffer{};
  pdu::VariableDatumWriter writer(buffer);
  ASSERT_TRUE(writer.add(7, std::as_bytes(std::span("first", 5))));
  ASSERT_TRUE(writer.add(8, std::as_bytes(std::span("second", 6))));
  comment.variable_datums = writer.datums();
  test::append_pdu(a, comment);
  Octets b = a;
  const std::size_t second = a.size() - 8;  // the value of the second, padded to 8
  b[second + 2] = std::byte{'X'};
  const auto found = pdu_differences(a, b);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].field, "variable_datum_records[1].variable_datum_value");
  EXPECT_EQ(found[0].offset, second + 2);
  EXPECT_EQ(found[0].a, "7365636f6e64");
}

TEST(PduDifferences, OfMutatedPdusAreFoundAndStayInside) {
  std::mt19937 random(11);
  const Octets whole = test::datagram_of({.entity = 1});
  const std::array<Octets, 2> pdus{Octets(whole.begin(), whole.begin() + 144),
                                   Octets(whole.begin() + 144, whole.end())};
  for (int round = 0; round < 5000; ++round) {
    std::array<Octets, 2> two{pdus[random() % 2], pdus[random() % 2]};
    for (Octets& octets : two) {
      for (std::size_t hits = random() % 3; hits > 0; --hits)
        octets[random() % octets.size()] = static_cast<std::byte>(random() & 0xFF);
      if (random() % 4 == 0) octets.resize(random() % octets.size());
      octets.shrink_to_fit();
    }
    EXPECT_EQ(pdu_differences(two[0], two[1]).empty(), two[0] == two[1]) << round;
  }
}

TEST(PduDifferences, OfAnyOctetsStayInsideAndAreFound) {
  Octets a;
  test::append_pdu(a, pdu::ElectromagneticEmission{});
  for (std::size_t size = 0; size < a.size(); ++size) {
    const Octets cut(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_FALSE(pdu_differences(a, cut).empty()) << size;
    EXPECT_FALSE(pdu_differences(cut, a).empty()) << size;
    EXPECT_TRUE(pdu_differences(cut, cut).empty()) << size;
  }
}

}  // namespace
}  // namespace reckon::tools
