// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The view `top`: the program's table, JSON and CSV of a capture.
#include "reckon/tools/inspect/top/top_view.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "reckon/pdu/reckon/datagram_trailer.hpp"
#include "reckon/tests/support/capture_builder.hpp"
#include "reckon/tests/support/reference_data.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"
#include "reckon/tests/tools/support/haptic_traffic.hpp"
#include "reckon/tests/tools/support/watched_entities.hpp"
#include "reckon/tools/inspect/top/columns.hpp"

namespace reckon::tools::top_view_test {
namespace {

using namespace watched;
using nlohmann::json;
using test::append_pdu;
using test::CaptureBuilder;
using test::Octets;
using test::run_reckon;
using ::testing::HasSubstr;

/// Two entities over 20 s; the second falls silent after 5 s.
class TopOfCapture : public ::testing::Test {
 protected:
  TopOfCapture() {
    for (int i = 0; i <= 20; ++i) {
      Octets datagram;
      append_pdu(datagram, entity_at(i, i % 2 == 0 ? 0.5 : 0.0, 1, "MOVER"));
      pdu::EntityState silent = entity_at(i, i, 2, "SILENT");
      silent.linear_velocity = {0, 0, 1};
      if (i <= 5) append_pdu(datagram, silent);
      capture_.add(datagram, after(i), {.host = 7});
    }
  }
  CaptureBuilder capture_;
};

TEST_F(TopOfCapture, PrintsOneLineAnEntity) {
  const auto result = run_reckon({"inspect", capture_.path(), "top"});
  const auto lines = result.lines();
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_THAT(lines[0], HasSubstr("ex 1   0:20   1 PDU/s   1 dgram/s"));
  EXPECT_THAT(lines[1], HasSubstr("ID     MARK    SIDE  KIND  DRM     HZ  WHY"));
  EXPECT_THAT(lines[2], HasSubstr("1:2:1  MOVER      1  air   2 fpw  1.0  threshold"));
  EXPECT_THAT(lines[2], HasSubstr("0.50 m  0.50 m  0.50 m  1.0s     0   0.0s"));
  EXPECT_THAT(lines[2], HasSubstr("239.1.2.3:3000  10.0.0.7:3000"));
  EXPECT_THAT(lines[3], HasSubstr("1:2:2  SILENT"));
  EXPECT_THAT(lines[3], HasSubstr("15.0s"));
  EXPECT_THAT(lines[3], HasSubstr("STALE"));
  EXPECT_EQ(result.status, 0);
}

TEST(Top, NamesTimeAndFrameOfTheGreatestJump) {
  CaptureBuilder capture;
  for (int i = 0; i <= 20; ++i) {
    Octets datagram;
    append_pdu(datagram, entity_at(i, i < 12 ? 0.0 : 500.0, 1, "MOVER"));
    capture.add(datagram, after(i));
  }
  const auto text = run_reckon({"inspect", capture.path(), "top"}).lines();
  EXPECT_THAT(text.at(1), HasSubstr("max     AT"));
  EXPECT_THAT(text.at(2), HasSubstr("500 m  12.0s"));
  const json row = json::parse(run_reckon({"inspect", capture.path(), "top", "--json"}).lines()[0]);
  EXPECT_NEAR(row["jump_max_m"], 500, 0.1);
  EXPECT_EQ(row["jump_max_at_s"], 12);
  EXPECT_EQ(row["jump_max_frame"], 13);
}

TEST(Top, MeasuresJumpsOfTheOrientationInDegrees) {
  CaptureBuilder capture;
  for (int i = 0; i <= 20; ++i) {
    pdu::EntityState pdu = entity_at(i, 0.0, 1, "TURNER");
    pdu.orientation.psi = i < 12 ? 3.1F : -3.1F;  // across pi: 4.8 degrees
    Octets datagram;
    append_pdu(datagram, pdu);
    capture.add(datagram, after(i));
  }
  const json row = json::parse(run_reckon({"inspect", capture.path(), "top", "--json"}).lines()[0]);
  EXPECT_NEAR(row["jump_max_deg"], 4.766, 1e-3);
  EXPECT_NEAR(row["jump_p50_deg"], 0, 1e-3);
  EXPECT_NEAR(row["jump_deg"], 0, 1e-3);
  const auto text = run_reckon({"inspect", capture.path(), "top"}).lines();
  EXPECT_THAT(text.at(1), HasSubstr("     TURN"));
  EXPECT_THAT(text.at(2), HasSubstr("4.8 deg"));
}

TEST_F(TopOfCapture, GivesJsonWithTheDocumentedKeys) {
  const auto lines = run_reckon({"inspect", capture_.path(), "top", "--json"}).lines();
  ASSERT_EQ(lines.size(), 3U);
  const json row = json::parse(lines[0]);
  EXPECT_EQ(row["id"], "1:2:1");
  EXPECT_EQ(row["marking"], "MOVER");
  EXPECT_EQ(row["why"], "threshold");
  EXPECT_EQ(row["updates"], 21);
  EXPECT_EQ(row["sent_first"], 1);
  EXPECT_EQ(row["sent_threshold"], 20);
  EXPECT_NEAR(row["jump_p50_m"], 0.5, 0.01);
  EXPECT_NEAR(row["jump_max_m"], 0.5, 1e-6);
  EXPECT_NEAR(row["rate_hz"], 1, 1e-6);
  EXPECT_EQ(row["stale"], false);
  EXPECT_TRUE(row["k1"].is_null());
  EXPECT_EQ(json::parse(lines[1])["stale"], true);
  const json summary = json::parse(lines[2]);
  EXPECT_EQ(summary["summary"], "top");
  EXPECT_EQ(summary["entities"], 2);
  EXPECT_EQ(summary["pdus"], 27);
  EXPECT_EQ(summary["datagrams"], 21);
}

TEST_F(TopOfCapture, GivesCsvWithAsManyCellsAsTitles) {
  const auto lines = run_reckon({"inspect", capture_.path(), "top", "--csv"}).lines();
  ASSERT_EQ(lines.size(), 3U);
  const auto commas = [](const std::string& line) {
    return std::count(line.begin(), line.end(), ',');
  };
  EXPECT_EQ(commas(lines[0]), static_cast<long>(top_members().size()) - 1);
  EXPECT_EQ(commas(lines[1]), commas(lines[0]));
  EXPECT_THAT(lines[1], HasSubstr("1:2:1,1,MOVER,1,1,2,2,21,1,threshold"));
}

TEST(InspectTop, WritesHarmlessMarkings) {
  CaptureBuilder capture;
  Octets datagram;
  append_pdu(datagram, entity_at(0, 0.0, 1, "\x1b[2J\n\x9b,x"));
  append_pdu(datagram, entity_at(0, 0.0, 2, "=1+2"));
  capture.add(datagram, after(0), {.host = 7});
  const auto result = run_reckon({"inspect", capture.path(), "top", "--csv"});
  const auto lines = result.lines();
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_THAT(lines[1], HasSubstr("1:2:1,1,\".[2J.\ufffd,x\","));
  EXPECT_THAT(lines[2], HasSubstr("1:2:2,1,'=1+2,"));
}

TEST_F(TopOfCapture, KeepsToTheFilter) {
  const auto lines =
      run_reckon({"inspect", capture_.path(), "top", "--where", "marking == silent"}).lines();
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_THAT(lines[2], HasSubstr("SILENT"));
}

/// Jumps of DRM 1, 2 and 4 from the fields that --full prints, by the formula.
TEST(InspectTop, JumpsEqualThoseComputedFromARealSession) {
  RECKON_NEED_DATA("dis-captures/real-sessions");
  const std::string file = test::reference_data() / "dis-captures/real-sessions/gaz69-patrol.pcap";
  struct Last {
    double timestamp = 0;
    std::array<double, 3> place{}, velocity{}, acceleration{};
    double largest = 0;
    int count = 0;
  };
  std::map<std::string, Last> entities;
  for (const std::string& line : run_reckon({"inspect", file, "--full"}).lines()) {
    const json row = json::parse(line);
    if (row["type"] != "entity_state") continue;
    const json& fields = row["fields"];
    ASSERT_THAT(row["drm"].get<int>(), testing::AnyOf(1, 2, 4));
    Last& last = entities[row["id"]];
    const double timestamp =
        (fields["header"]["timestamp"].get<std::uint32_t>() >> 1) * 3600.0 / 2147483647.0;
    std::array<double, 3> place{}, velocity{}, acceleration{};
    double square = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string axis(1, "xyz"[i]);
      place[i] = fields["entity_location"][axis];
      const double time = timestamp - last.timestamp;
      if (row["drm"] != 1) velocity[i] = fields["entity_linear_velocity"][axis];
      if (row["drm"] == 4)
        acceleration[i] = fields["dead_reckoning_parameters"]["entity_linear_acceleration"][axis];
      const double way = (last.velocity[i] + last.acceleration[i] * time / 2) * time;
      square += std::pow(place[i] - last.place[i] - way, 2);
    }
    if (last.count++ > 0) last.largest = std::max(last.largest, std::sqrt(square));
    last = {timestamp, place, velocity, acceleration, last.largest, last.count};
  }
  std::size_t compared = 0;
  for (const std::string& line : run_reckon({"inspect", file, "top", "--json"}).lines()) {
    const json row = json::parse(line);
    if (row.contains("summary")) continue;
    const Last& last = entities.at(row["id"]);
    EXPECT_EQ(row["updates"], last.count) << row["id"];
    if (last.count < 2) continue;
    EXPECT_NEAR(row["jump_max_m"], last.largest, 1e-3 + 1e-5 * last.largest) << row["id"];
    ++compared;
  }
  EXPECT_GT(compared, 0U);
}

TEST(InspectTop, ShowsAPlanesForceOnAProbe) {
  CaptureBuilder capture;
  pdu::EntityState table = entity_at(0, 0, 1, "TABLE");
  pdu::EntityState probe = entity_at(0, 0.004, 2, "PROBE");  // centre 4 mm above, radius 10 mm
  pdu::HapticRecord plane;
  plane.kind = pdu::ForceModelKind::plane;
  plane.k1 = 500;
  plane.damping = 4;
  plane.normal = {0, 0, 1};
  plane.validity_ms = 12'000;
  pdu::HapticRecord ball;
  ball.kind = pdu::ForceModelKind::sphere;
  ball.radius = 0.01F;
  ball.validity_ms = 12'000;
  Octets datagram;
  append_pdu(datagram, table);
  append_pdu(datagram, probe);
  test::append_attribute(datagram, table, plane);
  test::append_attribute(datagram, probe, ball);
  capture.add(datagram, after(0));
  // The table becomes stiffer: the force on the probe jumps by 6 mm times 100 N/m.
  plane.k1 = 600;
  table.header.timestamp = pdu::to_dis_timestamp(after(1), true);
  Octets second;
  append_pdu(second, table);
  test::append_attribute(second, table, plane);
  capture.add(second, after(1));

  const auto result = run_reckon({"inspect", capture.path(), "top", "--json"});
  const json row = json::parse(result.lines().at(0));
  EXPECT_NEAR(row["contact_n"], 600 * 0.006, 1e-3);
  EXPECT_NEAR(row["force_jump_p99_n"], 0.6, 1e-3);
  EXPECT_EQ(row["k1"], 600);
  EXPECT_EQ(row["damping"], 4);
  EXPECT_EQ(row["why"], "force");
  EXPECT_EQ(row["heartbeat_s"], 5);
  const auto text = run_reckon({"inspect", capture.path(), "top"}).out;
  EXPECT_THAT(text, HasSubstr("haptic"));
  EXPECT_THAT(text, HasSubstr("3.60 N  k1 600  b 4"));
}

TEST(InspectTop, CountsLossesFromTrailers) {
  CaptureBuilder capture;
  for (const std::uint32_t sequence : {1U, 2U, 5U}) {
    Octets datagram;
    append_pdu(datagram, entity_at(sequence, 0, 1, "A"));
    pdu::DatagramTrailer trailer;
    trailer.epoch = 9;
    trailer.sequence = sequence;
    append_pdu(datagram, trailer);
    capture.add(datagram, after(sequence));
  }
  EXPECT_THAT(run_reckon({"inspect", capture.path(), "top"}).out, HasSubstr("lost 2   bad 0"));
}

}  // namespace
}  // namespace reckon::tools::top_view_test
