// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Length of the JSON lines of Entity States: storage and pipe costs depend on it.
#include "reckon/tools/inspect/output/json_lines.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "reckon/pdu/management/comment.hpp"
#include "reckon/pdu/warfare/fire.hpp"
#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/capture_builder.hpp"

namespace reckon::tools::json_lines_test {
namespace {

using std::chrono::nanoseconds;
using test::append_pdu;
using test::Octets;

/// The line of the only PDU of a datagram.
template <typename Pdu>
std::string line_of(const Pdu& pdu, std::uint64_t frame, nanoseconds time,
                    std::size_t* allocations = nullptr, bool full = false) {
  Octets octets;
  append_pdu(octets, pdu);
  peer::SourceDatagram datagram;
  datagram.frame = frame;
  datagram.time = time;
  datagram.bytes = octets;
  std::string line;
  line.reserve(4096);
  DatagramInspector inspector;
  const test::AllocationGuard guard;
  (void)inspector.inspect(datagram, [&](const PduRow& row) {
    append_json_line(line, row, full);
    return true;
  });
  if (allocations != nullptr) *allocations = guard.count();
  return line;
}

pdu::EntityState plain() {
  pdu::EntityState pdu;
  pdu.entity_id = {100, 20, 300};
  pdu.force_id = pdu::ForceId::friendly;
  pdu.location = {-4437345.6789, -1061234.5, -4443210.0625};
  pdu.dead_reckoning.algorithm = pdu::DeadReckoningAlgorithm::rvw;
  pdu.marking.set("ELEVEN CHAR");
  return pdu;
}

// Frame 1 million of a capture, a marking of all 11 characters, every coordinate with its sign.
TEST(InspectJson, PlainEntityStateHas330OctetsWithoutHeap) {
  std::size_t allocations = 1;
  const std::string line =
      line_of(plain(), 1'000'000, nanoseconds(1'700'000'000'123'456'789), &allocations);
  RecordProperty("octets", static_cast<int>(line.size()));
  EXPECT_LE(line.size(), 330U) << line;
  EXPECT_GE(line.size(), 310U) << "shorter than docs/accuracy_and_cost.md says: " << line;
  EXPECT_EQ(allocations, 0U);
  const auto row = nlohmann::json::parse(line);
  EXPECT_EQ(row["marking"], "ELEVEN CHAR");
  EXPECT_EQ(row["location"][0], -4437345.679);
  EXPECT_NEAR(row["latitude"].get<double>(), -44.4, 0.5);
  EXPECT_NEAR(row["longitude"].get<double>(), -166.55, 0.01);
  EXPECT_NEAR(row["height"].get<double>(), 0.0, 30000.0);
}

TEST(InspectJson, GivesThePositionOfAnyPdu) {
  pdu::Fire fire;
  fire.location_in_world_coordinates = {0, 6378137 + 100, 0};
  const auto row = nlohmann::json::parse(line_of(fire, 1, {}));
  EXPECT_EQ(row["location"][1], 6378237.0);
  EXPECT_EQ(row["latitude"], 0.0);
  EXPECT_EQ(row["longitude"], 90.0);
  EXPECT_EQ(row["height"], 100.0);
  EXPECT_FALSE(row.contains("heading"));
  const auto nowhere = nlohmann::json::parse(line_of(pdu::Comment{}, 1, {}));
  EXPECT_FALSE(nowhere.contains("location") || nowhere.contains("latitude"));
}

// Half of the line is the datum in hexadecimal, half its text.
TEST(InspectJson, WritesAllFieldsOfPdusOfAnyLength) {
  for (const std::size_t length : {8U, 8'000U, 16'000U, 60'000U}) {
    const std::string text(length, 'A');
    std::vector<std::byte> room(length + 64);
    pdu::VariableDatumWriter writer(room);
    ASSERT_TRUE(writer.add(7, std::as_bytes(std::span(text))));
    pdu::Comment pdu;
    pdu.variable_datums = writer.datums();
    const auto row = nlohmann::json::parse(line_of(pdu, 1, {}, nullptr, true));
    const auto& datum = row["fields"]["variable_datum_records"][0];
    EXPECT_EQ(datum["variable_datum_value"].get<std::string>().size(), 2 * length);
    EXPECT_EQ(datum["variable_datum_text"], text);
  }
}

// The maximum of an Entity State without a finding: numbers at their longest, a marking that is no
// text, positions at the end of the range of a double (309 digits each).
TEST(InspectJson, LongestEntityStateHasUnder1400Octets) {
  pdu::EntityState pdu = plain();
  pdu.entity_id = {65535, 65535, 65535};
  pdu.force_id = static_cast<pdu::ForceId>(255);
  const double far = -std::numeric_limits<double>::max();
  pdu.location = {far, far, far};
  pdu.dead_reckoning.algorithm = static_cast<pdu::DeadReckoningAlgorithm>(255);
  for (char& letter : pdu.marking.text) letter = '\x01';
  const std::string line = line_of(pdu, std::numeric_limits<std::uint64_t>::max(),
                                   nanoseconds(std::numeric_limits<std::int64_t>::min()));
  RecordProperty("octets", static_cast<int>(line.size()));
  EXPECT_LT(line.size(), 1400U);
  EXPECT_EQ(nlohmann::json::parse(line)["status"], "ok");
}

}  // namespace
}  // namespace reckon::tools::json_lines_test
