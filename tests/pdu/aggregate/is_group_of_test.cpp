// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The descriptions of the golden sample are of category 6.
#include "reckon/pdu/aggregate/is_group_of.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "reckon/pdu/print.hpp"

namespace reckon::pdu {
namespace {

using Octets = std::vector<std::byte>;

nlohmann::json shown(unsigned category, std::size_t count, const Octets& descriptions) {
  IsGroupOf pdu;
  pdu.grouped_entity_category = static_cast<std::uint8_t>(category);
  pdu.number_of_grouped_entities = static_cast<std::uint8_t>(count);
  pdu.grouped_entity_descriptions.bytes = descriptions;
  std::string text;
  TextSink sink(text);
  print_json(pdu, sink);
  return nlohmann::json::parse(text)["grouped_entity_descriptions"];
}

TEST(IsGroupOf, ShowsTheDescriptionsOfEachCategory) {
  // Octets of one description, and the name of its last field.
  struct Row {
    std::size_t size;
    const char* last;
  };
  const std::vector<Row> rows = {
      {20, "gun_elevation_rate"},   {24, "secondary_ammunition"}, {20, "head_elevation_rate"},
      {24, "secondary_ammunition"}, {24, "gun_elevation_rate"},   {28, "secondary_ammunition"},
      {20, "movement_speed"},       {24, "secondary_ammunition"}, {16, "speed"}};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    Octets octets(3 * rows[i].size);
    octets[2 * rows[i].size + 1] = std::byte{9};  // entity number of the third
    octets.back() = std::byte{5};                 // its last field
    const auto entities = shown(static_cast<unsigned>(i + 1), 3, octets);
    ASSERT_EQ(entities.size(), 3U) << i + 1;
    EXPECT_EQ(entities[2]["entity_number"], 9) << i + 1;
    EXPECT_EQ(entities[2][rows[i].last], 5) << i + 1;
    EXPECT_EQ(entities[1][rows[i].last], 0) << i + 1;
  }
}

TEST(IsGroupOf, KeepsOctetsThatAreNoDescriptions) {
  EXPECT_TRUE(shown(1, 2, Octets(39)).is_string()) << "an octet is missing";
  EXPECT_TRUE(shown(1, 2, Octets(41)).is_string()) << "an octet is left";
  EXPECT_TRUE(shown(0, 1, Octets(20)).is_string()) << "undefined category";
  EXPECT_TRUE(shown(10, 1, Octets(20)).is_string()) << "unknown category";
  EXPECT_TRUE(shown(1, 0, {}).is_string());
}

}  // namespace
}  // namespace reckon::pdu
