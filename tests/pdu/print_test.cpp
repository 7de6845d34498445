// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/pdu/print.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/wire_samples.hpp"

namespace reckon::pdu::print_test {
namespace {

std::string tree(std::span<const std::byte> octets) {
  std::string text;
  TextSink sink(text);
  static_cast<void>(print_pdu_tree(octets, sink));
  return text;
}

std::string json(std::span<const std::byte> octets) {
  std::string text;
  TextSink sink(text);
  static_cast<void>(print_pdu_json(octets, sink));
  return text;
}

TEST(PrintTree, GivesALinePerFieldWithEnumerationNames) {
  const std::string text = tree(test::sample_octets("entity_state"));
  EXPECT_NE(text.find("entity_id site 100 application 7 entity 3\n"), std::string::npos) << text;
  EXPECT_NE(text.find("force_id 1 (Friendly)\n"), std::string::npos) << text;
  EXPECT_NE(text.find("  dead_reckoning_algorithm 4 (DRM RVW)\n"), std::string::npos) << text;
  EXPECT_NE(text.find("entity_marking_string \"HAND-1\""), std::string::npos) << text;
  EXPECT_NE(text.find("parameter_value 0.75"), std::string::npos) << text;
}

TEST(PrintTree, ShowsHapticEnergyAndForeignRecords) {
  const std::string text = tree(test::sample_octets("attribute"));
  EXPECT_NE(text.find("kind 2 (Sphere)"), std::string::npos) << text;
  EXPECT_NE(text.find("given 0.001953125"), std::string::npos) << text;
  EXPECT_NE(text.find("record_type 252000 record_length 16 body 00010203"), std::string::npos)
      << text;
}

TEST(PrintTree, ShowsVariableDatums) {
  const std::string text = tree(test::sample_octets("comment"));
  EXPECT_NE(text.find("variable_datum_id 3000 ("), std::string::npos) << text;
  EXPECT_NE(text.find(" variable_datum_length 96"), std::string::npos) << text;
}

TEST(PrintJson, GivesTheOctetsOfAnUnknownType) {
  std::array<std::byte, 14> octets{std::byte{7}, std::byte{1}, std::byte{200}, std::byte{150}};
  store_big_endian(octets.data() + 8, std::uint16_t{14});
  octets[13] = std::byte{0xAB};
  const auto value = nlohmann::json::parse(json(octets));
  EXPECT_EQ(value["header"]["pdu_type"], 200);
  EXPECT_EQ(value["body"], "00ab");
}

TEST(PrintJson, ShowsADamagedPduUpToTheFault) {
  std::vector<std::byte> octets = test::sample_octets("entity_state");
  const auto whole = nlohmann::json::parse(json(octets));
  const auto cut = nlohmann::json::parse(json(std::span(octets).first(50)));  // within the location
  EXPECT_EQ(cut["header"], whole["header"]);
  EXPECT_EQ(cut["entity_id"], whole["entity_id"]);
  EXPECT_EQ(cut["entity_linear_velocity"], whole["entity_linear_velocity"]);
  EXPECT_FALSE(cut.contains("entity_location"));
  EXPECT_EQ(cut["rest"].get<std::string>().size(), 2 * (50U - 48U));

  octets[19] = std::byte{200};  // more records than the PDU has
  const auto lying = nlohmann::json::parse(json(octets));
  EXPECT_EQ(lying["number_of_variable_parameter_records"], 200);
  EXPECT_EQ(lying["entity_location"], whole["entity_location"]);
  EXPECT_EQ(lying["entity_marking"], whole["entity_marking"]);
  EXPECT_EQ(lying["rest"].get<std::string>().size(), 2 * (octets.size() - 144));

  octets[8] = octets[9] = std::byte{0};
  const auto of_length_0 = nlohmann::json::parse(json(octets));
  EXPECT_EQ(of_length_0["header"]["length"], 0);
  EXPECT_EQ(of_length_0["entity_location"], whole["entity_location"]);
  EXPECT_NE(tree(octets).find("entity_id site 100 application 7 entity 3\n"), std::string::npos);
}

TEST(PrintJson, IsValidForEveryCutOfASample) {
  const auto octets = test::sample_octets("attribute");
  for (std::size_t size = 0; size < octets.size(); ++size)
    EXPECT_TRUE(nlohmann::json::accept(json(std::span(octets).first(size)))) << size;
}

TEST(PrintJson, WritesNullForNaNAndEscapesCharacters) {
  EntityState pdu;
  pdu.location.x = std::numeric_limits<double>::quiet_NaN();
  pdu.marking.set("a\"\\\n\xFF");
  std::string text;
  TextSink sink(text);
  print_json(pdu, sink);
  const auto value = nlohmann::json::parse(text);
  EXPECT_TRUE(value["entity_location"]["x"].is_null());
  EXPECT_EQ(value["entity_marking"]["entity_marking_string"], "a\"\\\n\xC3\xBF");
}

TEST(TextSink, CutsAtItsBufferAndAllocatesNothing) {
  const auto octets = test::sample_octets("entity_state");
  std::array<char, 100> buffer;
  const test::AllocationGuard guard;
  TextSink sink{std::span<char>(buffer)};
  const DecodeError error = print_pdu_json(octets, sink);
  const std::size_t allocations = guard.count();
  EXPECT_EQ(error, DecodeError::none);
  EXPECT_EQ(allocations, 0U);
  EXPECT_TRUE(sink.truncated());
  EXPECT_EQ(sink.view(), json(octets).substr(0, 100));
}

}  // namespace
}  // namespace reckon::pdu::print_test
