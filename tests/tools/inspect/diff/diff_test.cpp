// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon inspect diff`: captures that differ in exactly the change of the test.
#include "reckon/tools/inspect/diff/diff.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "reckon/pdu/codec/byte_order.hpp"
#include "reckon/pdu/management/comment.hpp"
#include "reckon/tests/support/reference_data.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"
#include "reckon/tests/tools/support/haptic_traffic.hpp"
#include "reckon/tools/captures/timestamp_rewrite.hpp"

namespace reckon::tools {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;
using test::Ball;
using test::CaptureBuilder;
using test::Octets;
using test::run_reckon;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr nanoseconds kStart = seconds(1'700'000'000);

struct Datagram {
  Octets octets;
  nanoseconds time;
};
using Capture = std::vector<Datagram>;

/// Two balls, 25 updates each 40 ms apart, one bundle at a time: Entity State, Attribute.
Capture two_balls() {
  Capture capture;
  for (int i = 0; i < 50; ++i) {
    Ball ball{.entity = static_cast<std::uint16_t>(1 + i % 2), .up = i % 2 == 0 ? 0.0 : 0.015};
    ball.time = kStart + milliseconds(20 * i);
    capture.push_back({test::datagram_of(ball), ball.time});
  }
  return capture;
}

/// A capture file that is removed at the end of its scope.
struct File {
  explicit File(const Capture& capture, nanoseconds shift = nanoseconds::zero()) {
    for (const Datagram& datagram : capture) builder.add(datagram.octets, datagram.time + shift);
    path = builder.path();
  }
  CaptureBuilder builder;
  std::string path;
};

test::ProgramResult diff(const File& a, const File& b, std::vector<std::string> more = {}) {
  std::vector<std::string> words{"inspect", "diff", a.path, b.path};
  words.insert(words.end(), more.begin(), more.end());
  return run_reckon(words);
}

/// The objects of one kind.
std::vector<json> rows(const test::ProgramResult& result, const std::string& kind) {
  std::vector<json> found;
  for (const std::string& line : result.lines()) {
    const json row = json::parse(line);
    if (row["kind"] == kind) found.push_back(row);
  }
  return found;
}

TEST(InspectDiff, FindsNothingBetweenACaptureAndItself) {
  const File file(two_balls());
  const auto result = diff(file, file, {"--json"});
  EXPECT_EQ(result.status, 0) << result.err;
  const json all = rows(result, "all").at(0);
  EXPECT_EQ(all["same"], true);
  EXPECT_EQ(all["pdus_same"], 100);
  EXPECT_EQ(all["shift"], 0.0);
  EXPECT_EQ(all["time_max"], 0);
  ASSERT_EQ(rows(result, "pose").size(), 2U);
  for (const json& pose : rows(result, "pose")) EXPECT_EQ(pose["max_m"], 0);
  ASSERT_EQ(rows(result, "contact_force").size(), 2U);
  for (const json& force : rows(result, "contact_force")) EXPECT_EQ(force["max"], 0);
  EXPECT_THAT(diff(file, file).out, HasSubstr("100 PDUs in both, in the same order"));
}

TEST(InspectDiff, NamesFieldOctetAndBothValues) {
  Capture changed = two_balls();
  // entity_location.x of the 7th datagram's Entity State, at octet 48.
  pdu::store_big_endian(changed[6].octets.data() + 48, test::kGround + 2.0);
  const File a(two_balls());
  const File b(changed);
  const auto result = diff(a, b, {"--json"});
  EXPECT_EQ(result.status, 1);
  const json first = rows(result, "first_changed").at(0);
  EXPECT_EQ(first["a"]["frame"], 7);
  EXPECT_EQ(first["b"]["pdu"], 1);
  EXPECT_EQ(first["id"], "1:2:1");
  ASSERT_EQ(first["fields"].size(), 1U);
  const json field = first["fields"][0];
  EXPECT_EQ(field["field"], "entity_location.x");
  EXPECT_EQ(field["at"], 48);
  EXPECT_EQ(std::stod(field["a"].get<std::string>()), test::kGround);
  EXPECT_EQ(std::stod(field["b"].get<std::string>()), test::kGround + 2.0);
  EXPECT_EQ(rows(result, "all").at(0)["pdus_changed"], 1);
  EXPECT_EQ(rows(result, "all").at(0)["pdus_same"], 99);
  // It is 2 m off until its next update, and no longer touches ball 2.
  const json pose = rows(result, "pose").at(0);
  EXPECT_EQ(pose["id"], "1:2:1");
  EXPECT_NEAR(pose["max_m"].get<double>(), 2.0, 1e-6);
  const json force = rows(result, "contact_force").at(0);
  EXPECT_NEAR(force["max"].get<double>(), 500 * 0.005 + 1e6 * 0.005 * 0.005 * 0.005, 1e-4);
  EXPECT_THAT(
      diff(a, b).out,
      HasSubstr("octet 48 (datagram +48): entity_location.x is 6378137 in A, 6378139 in B"));
}

TEST(InspectDiff, NamesFieldsOfRecordsInsideAttributePdus) {
  Capture changed = two_balls();
  Ball softer{.entity = 1, .k1 = 250};
  softer.time = changed[0].time;
  changed[0].octets = test::datagram_of(softer);
  const auto result = diff(File(two_balls()), File(changed), {"--json"});
  const json first = rows(result, "first_changed").at(0);
  ASSERT_EQ(first["fields"].size(), 1U);
  EXPECT_EQ(first["fields"][0]["field"], "attribute_record_sets[0].attribute_records[0].k1");
  EXPECT_EQ(first["fields"][0]["at"], 32 + 8 + 16);  // PDU, record set, offset in the record
  EXPECT_EQ(first["a"]["offset"], 144);
  EXPECT_EQ(rows(result, "field").at(0)["field"], "attribute_record_sets[].attribute_records[].k1");
}

TEST(InspectDiff, FindsAMissingPduAndContinues) {
  Capture shorter = two_balls();
  shorter[20].octets.resize(144);  // without its Attribute
  const auto result = diff(File(two_balls()), File(shorter), {"--json"});
  EXPECT_EQ(result.status, 1);
  const json only = rows(result, "only").at(0);
  EXPECT_EQ(only["in"], "a");
  EXPECT_EQ(only["type"], "attribute");
  EXPECT_EQ(only["frame"], 21);
  EXPECT_EQ(only["pdu"], 2);
  const json all = rows(result, "all").at(0);
  EXPECT_EQ(all["pdus_same"], 99);
  EXPECT_EQ(all["only_a"], 1);
  EXPECT_EQ(all["only_b"], 0);
  EXPECT_EQ(all["pdus_changed"], 0);
  const auto mirrored = diff(File(shorter), File(two_balls()));
  EXPECT_THAT(mirrored.out, HasSubstr("99 PDUs in both, 0 changed, 0 only in A, 1 only in B"));
  EXPECT_THAT(mirrored.out, HasSubstr("ONLY IN B\n  frame 21 PDU 2: attribute 1:2:1"));
}

TEST(InspectDiff, RemovesAndReportsAConstantTimeShift) {
  const File a(two_balls());
  const File b(two_balls(), seconds(5000) + nanoseconds(7));
  const auto result = diff(a, b, {"--json"});
  EXPECT_EQ(result.status, 0);
  const json all = rows(result, "all").at(0);
  EXPECT_DOUBLE_EQ(all["shift"].get<double>(), 5000.000000007);
  EXPECT_EQ(all["time_max"], 0);
  for (const json& pose : rows(result, "pose")) EXPECT_EQ(pose["max_m"], 0);
  for (const json& force : rows(result, "contact_force")) EXPECT_EQ(force["max"], 0);
  EXPECT_EQ(diff(a, b, {"--align", "none", "--within", "1s"}).status, 1);
}

/// The same datagrams, `rate` times as fast.
Capture played(Capture capture, double rate) {
  for (Datagram& datagram : capture) {
    const auto since = static_cast<double>((datagram.time - kStart).count());
    datagram.time = kStart + seconds(100) + nanoseconds(std::llround(since / rate));
  }
  return capture;
}

/// Two balls that move apart at 5 m/s: a second is 5 m.
Capture two_flying_balls() {
  Capture capture;
  for (int i = 0; i < 50; ++i) {
    const double t = 0.02 * i;
    Ball ball{.entity = static_cast<std::uint16_t>(1 + i % 2), .up = 5 * t, .rising = 5};
    ball.time = kStart + milliseconds(20 * i);
    capture.push_back({test::datagram_of(ball), ball.time});
  }
  return capture;
}

TEST(InspectDiff, PairsACaptureOfAnotherRate) {
  const File a(two_flying_balls());
  for (const double rate : {0.25, 2.0, 8.0}) {
    SCOPED_TRACE(rate);
    const File b(played(two_flying_balls(), rate));
    const auto result = diff(a, b, {"--json"});
    EXPECT_EQ(result.status, 0);
    const json all = rows(result, "all").at(0);
    EXPECT_NEAR(all["rate"], rate, 1e-6);
    EXPECT_NEAR(all["time_max"], 0, 1e-8);
    EXPECT_EQ(rows(result, "pose").size(), 2U);
    for (const json& pose : rows(result, "pose")) EXPECT_EQ(pose["max_m"], 0);
    for (const json& force : rows(result, "contact_force")) EXPECT_EQ(force["max"], 0);
    // Compared by the clock they are far apart.
    EXPECT_GT(rows(diff(a, b, {"--json", "--align", "first"}), "pose").at(0)["max_m"], 0.1);
  }
  EXPECT_THAT(diff(a, File(played(two_flying_balls(), 2))).out,
              HasSubstr("was played 2 times as fast: its times are scaled to A's"));
}

TEST(InspectDiff, FindsChangesInACaptureOfAnotherRate) {
  const File a(two_flying_balls());
  Capture changed = played(two_flying_balls(), 2);
  Ball moved{.entity = 1, .up = 5 * 0.02 * 20 + 3, .rising = 5};
  moved.time = kStart + milliseconds(20 * 20);
  changed[20].octets = test::datagram_of(moved);
  changed.erase(changed.begin() + 30);
  const auto result = diff(a, File(changed), {"--json"});
  EXPECT_EQ(result.status, 1);
  const json all = rows(result, "all").at(0);
  EXPECT_EQ(all["pdus_changed"], 1);
  EXPECT_EQ(all["only_a"], 2);
  const auto poses = rows(result, "pose");
  EXPECT_NEAR(poses.at(0)["max_m"], 3, 0.01);
  EXPECT_NEAR(poses.at(0)["max_m_at"], 0.4, 0.021);
}

TEST(InspectDiff, PairsAReplayWithOtherTimestampsToo) {
  Capture restamped = played(two_flying_balls(), 2);
  for (Datagram& datagram : restamped) rewrite_timestamps(datagram.octets, datagram.time);
  const auto result = diff(File(two_flying_balls()), File(restamped), {"--json", "--ignore-time"});
  EXPECT_EQ(result.status, 0);
  for (const json& pose : rows(result, "pose")) EXPECT_EQ(pose["max_m"], 0);
}

TEST(InspectDiff, HoldsArrivalsAgainstATolerance) {
  Capture late = two_balls();
  late[10].time += milliseconds(3);
  const File a(two_balls());
  const File b(late);
  EXPECT_EQ(diff(a, b).status, 0);
  EXPECT_EQ(diff(a, b, {"--within", "5ms"}).status, 0);
  EXPECT_EQ(diff(a, b, {"--within", "2ms"}).status, 1);
  EXPECT_NEAR(rows(diff(a, b, {"--json"}), "all").at(0)["time_max"].get<double>(), 0.003, 1e-12);
}

TEST(InspectDiff, DistinguishesAnotherOrderFromOtherPdus) {
  Capture swapped = two_balls();
  std::swap(swapped[30].octets, swapped[31].octets);
  const auto result = diff(File(two_balls()), File(swapped), {"--json"});
  EXPECT_EQ(result.status, 1);
  const json all = rows(result, "all").at(0);
  EXPECT_EQ(all["only_a"], 0);
  EXPECT_EQ(all["only_b"], 0);
  EXPECT_EQ(all["pdus_changed"], 0);
  EXPECT_EQ(all["pdus_moved"], 2);  // one Entity State and its Attribute
  EXPECT_EQ(all["pdus_same"], 98);
  EXPECT_EQ(rows(result, "first_moved").at(0)["type"], "entity_state");
}

TEST(InspectDiff, LeavesTimesInsidePdusOutWhenAsked) {
  Capture restamped = two_balls();
  for (Datagram& datagram : restamped) {
    datagram.octets[6] ^= std::byte{0x11};        // in the Entity State's timestamp
    datagram.octets[144 + 5] ^= std::byte{0x22};  // in the Attribute's timestamp
  }
  const File a(two_balls());
  const File b(restamped);
  EXPECT_EQ(diff(a, b, {"--ignore-time"}).status, 0);
  const auto result = diff(a, b, {"--json"});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(rows(result, "all").at(0)["pdus_changed"], 100);
  const auto fields = rows(result, "field");
  ASSERT_EQ(fields.size(), 1U);
  EXPECT_EQ(fields[0]["field"], "header.timestamp");
  EXPECT_EQ(fields[0]["pdus"], 100);
}

TEST(InspectDiff, ReportsChangedEntityAttributes) {
  Capture other;
  for (const Datagram& datagram : two_balls()) {
    Octets octets = datagram.octets;
    if (octets[17] == std::byte{2}) {
      octets[18] = std::byte{2};  // force: opposing
      octets[88] = std::byte{5};  // DRM FVW
      octets[129] = std::byte{'T'};
    }
    other.push_back({octets, datagram.time});
  }
  const auto result = diff(File(two_balls()), File(other), {"--json"});
  const auto entities = rows(result, "entity");
  ASSERT_EQ(entities.size(), 2U);
  EXPECT_EQ(entities[0]["differs"], false);
  EXPECT_EQ(entities[1]["differs"], true);
  EXPECT_EQ(entities[1]["a_marking"], "BALL2");
  EXPECT_EQ(entities[1]["b_marking"], "TALL2");
  EXPECT_EQ(entities[1]["a_force_id"], 1);
  EXPECT_EQ(entities[1]["b_force_id"], 2);
  EXPECT_EQ(entities[1]["a_drm"], json({2}));
  EXPECT_EQ(entities[1]["b_drm"], json({5}));
}

TEST(InspectDiff, AppliesTheFilterToBoth) {
  Capture changed = two_balls();
  changed[0].octets[144 + 32 + 8 + 16] ^= std::byte{1};
  const File a(two_balls());
  const File b(changed);
  EXPECT_EQ(diff(a, b).status, 1);
  const auto states = diff(a, b, {"--where", "type == entity_state", "--json"});
  EXPECT_EQ(states.status, 0);
  EXPECT_EQ(rows(states, "all").at(0)["pdus_same"], 50);
  const auto wrong = diff(a, b, {"--where", "knd == 1"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err, HasSubstr("column 1"));
}

TEST(InspectDiff, ComparesCapturesThatHaveNothingInCommon) {
  Capture empty;
  Capture foreign;
  Octets comment;
  test::append_pdu(comment, pdu::Comment{});
  foreign.push_back({comment, kStart});
  for (const Capture& other : {empty, foreign}) {
    const auto result = diff(File(two_balls()), File(other), {"--json"});
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(rows(result, "all").at(0)["only_a"], 100);
    EXPECT_TRUE(rows(result, "pose").empty());
  }
  EXPECT_EQ(diff(File(empty), File(empty)).status, 0);
}

TEST(InspectDiff, WritesOneTableAsCsv) {
  Capture shorter = two_balls();
  shorter.pop_back();
  const auto lines = diff(File(two_balls()), File(shorter), {"--csv"}).lines();
  EXPECT_EQ(lines.at(0), "what,key,a,b,difference");
  EXPECT_EQ(lines.at(1), "pdus,,100,98,-2");
  EXPECT_THAT(lines, ::testing::Contains("only_a,entity_state 1:2:2,50.1,,"));
  EXPECT_THAT(lines, ::testing::Contains("type,attribute,50,49,-1"));
}

TEST(InspectDiff, RefusesUnreadableFilesAndUsage) {
  const File good(two_balls());
  EXPECT_EQ(run_reckon({"inspect", "diff", good.path, "no-such-file.pcap"}).status, 2);
  EXPECT_EQ(run_reckon({"inspect", "diff", good.path}).status, 2);
  EXPECT_EQ(run_reckon({"inspect", "diff", good.path, "-"}).status, 2);
  EXPECT_EQ(run_reckon({"inspect", "diff", good.path, good.path, "--csv", "--json"}).status, 2);
  EXPECT_THAT(run_reckon({"inspect", "diff", "--help"}).out, HasSubstr("--ignore-time"));
}

TEST(InspectDiff, FindsRecordedSessionsTheSameAsThemselves) {
  RECKON_NEED_DATA("dis-captures/real-sessions");
  const std::string file = test::reference_data() / "dis-captures/real-sessions/gaz69-patrol.pcap";
  const auto result = run_reckon({"inspect", "diff", file, file, "--json"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(rows(result, "all").at(0)["pdus_same"], 383);
}

}  // namespace
}  // namespace reckon::tools
