// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The golden sample has all columns.
#include "reckon/pdu/minefield/minefield_data.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "reckon/pdu/finite.hpp"
#include "reckon/pdu/print.hpp"
#include "reckon/tests/support/wire_samples.hpp"

namespace reckon::pdu {
namespace {

using Octets = std::vector<std::byte>;

template <typename Pdu>
nlohmann::json shown(const Pdu& pdu) {
  std::string text;
  TextSink sink(text);
  print_json(pdu, sink);
  return nlohmann::json::parse(text);
}

nlohmann::json shown(std::uint32_t data_filter, std::size_t octets) {
  const Octets mines(octets);
  MinefieldData pdu;
  pdu.number_of_mines = 3;
  pdu.data_filter = data_filter;
  pdu.mines.bytes = mines;
  return shown(pdu);
}

TEST(MinefieldData, HasTheColumnsOfItsFilter) {
  // Three mines: locations and entity numbers are always present, in 42 octets and 2 of padding.
  const auto plain = shown(0, 44);
  EXPECT_EQ(plain["mine_locations"].size(), 3U);
  EXPECT_EQ(plain["mine_entity_numbers"].size(), 3U);
  EXPECT_EQ(plain["padding_behind_mines"], "0000");
  EXPECT_FALSE(plain.contains("fusings") || plain.contains("reflectances"));
  EXPECT_EQ(shown(1U << 5, 44 + 12)["reflectances"].size(), 3U);
  EXPECT_EQ(shown(1U << 3, 44 + 36)["mine_orientations"].size(), 3U);
  EXPECT_EQ(shown(1U << 6, 44 + 24)["mine_emplacement_times"].size(), 3U);
  EXPECT_EQ(shown(1U << 8, 48)["fusings"].size(), 3U);
  EXPECT_EQ(shown(1U << 10, 48)["paint_schemes"].size(), 3U);
  EXPECT_EQ(shown(1U << 7, 48)["numbers_of_wires"].size(), 3U);
  EXPECT_TRUE(shown(1U << 7, 48)["wire_vertices"].empty());
  EXPECT_EQ(shown(0, 42)["padding_behind_mines"], "") << "the end of the PDU may lack its padding";
}

TEST(MinefieldData, KeepsOctetsThatAreNoColumns) {
  EXPECT_TRUE(shown(0, 41).contains("mines")) << "an octet is missing";
  EXPECT_TRUE(shown(0, 48).contains("mines")) << "octets are left";
  EXPECT_TRUE(shown(1U << 11, 44).contains("mines")) << "an unknown column";
  EXPECT_FALSE(shown(0, 44).contains("mines"));
}

TEST(MinefieldData, NamesAColumnThatIsNotFinite) {
  Octets octets = test::sample_octets("minefield_data");
  store_big_endian(octets.data() + 84, std::uint32_t{0x7FC00000});  // after 36 octets of locations
  MinefieldData pdu;
  ASSERT_EQ(decode(octets, pdu), DecodeError::none);
  EXPECT_EQ(first_not_finite(pdu), "ground_burial_depth_offsets");
}

}  // namespace
}  // namespace reckon::pdu
