// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon inspect check`: the text of a finding, events that are not a fault over time, and
// recorded exercises of a real product, whose only finding is a datagram that was cut.
#include "reckon/tools/inspect/check/check_view.hpp"

#include <gmock/gmock.h>

#include <map>
#include <string>
#include <vector>

#include "reckon/peer/capture/capture_file.hpp"
#include "reckon/tests/support/reference_data.hpp"
#include "reckon/tests/tools/support/checked_traffic.hpp"

namespace reckon::tools::check_view_test {
namespace {

using namespace checks;
using nlohmann::json;
using test::Sender;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(InspectCheck, WritesAFindingWithItsJsonKeys) {
  CaptureBuilder capture;
  pdu::EntityState pdu = truck(seconds(0));
  pdu.force_id = pdu::ForceId{77};
  Octets datagram;
  append_pdu(datagram, pdu::Comment{});
  append_pdu(datagram, pdu);
  capture.add(datagram, kStart);
  const auto lines = run_reckon({"inspect", capture.path(), "check", "--json"}).lines();
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[0],
            R"({"rule":"W-SIDE","status":"warning","frame":1,"pdu":2,"offset":32,"at":50,)"
            R"("time":1700000000.000000000,"id":"1:2:3",)"
            R"("reason":"force_id is 77, but 0 to 30 have names",)"
            R"("sentence":"The force ID has no name.","remedy":"send 0 to 30"})");
  EXPECT_EQ(json::parse(lines[1])["rule"], "I-BUNDLE-ORDER");
  EXPECT_EQ(lines[2],
            R"({"summary":"check","datagrams":1,"pdus":2,"errors":0,"warnings":1,"notes":1,)"
            R"("rules":{"I-BUNDLE-ORDER":1,"W-SIDE":1}})");
}

TEST(InspectCheck, PrintsFrameOctetReasonAndRemedy) {
  CaptureBuilder capture;
  drive(capture);
  in_fields([](auto& pdu) { pdu.dead_reckoning.algorithm = pdu::DeadReckoningAlgorithm{77}; })(
      capture);
  const auto result = run_reckon({"inspect", capture.path(), "check"});
  EXPECT_THAT(result.out, StartsWith("frame 5     PDU 1  +88    W-DRM                  1:2:3       "
                                     " dead_reckoning_algorithm is 77, but 0 to 9 have names\n"));
  EXPECT_THAT(result.out, HasSubstr("     1 x W-DRM"));
  EXPECT_THAT(result.out, HasSubstr("fix: send 0 to 9"));
  EXPECT_THAT(result.out, HasSubstr("6 PDUs in 5 datagrams: 0 errors, 1 warning, 0 notes\n"));
}

TEST(InspectCheck, WritesCsvWithTitles) {
  CaptureBuilder capture;
  in_fields([](auto& pdu) { pdu.force_id = pdu::ForceId{99}; })(capture);
  const auto lines = run_reckon({"inspect", capture.path(), "check", "--csv"}).lines();
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0], "rule,frame,pdu,offset,at,time,id,reason,remedy");
  EXPECT_EQ(lines[1],
            "W-SIDE,1,1,0,18,1700000004.000000000,1:2:3,\"force_id is 99, but 0 to 30 have "
            "names\",send 0 to 30");
}

TEST(InspectCheck, ReportsALastingFaultOnceUntilCorrected) {
  CaptureBuilder capture;
  for (int i = 0; i < 9; ++i) {
    pdu::EntityState pdu = truck(seconds(i));
    const bool ahead = i < 3 || i > 5;
    if (ahead) pdu.header.timestamp = pdu::to_dis_timestamp(kStart + seconds(i + 60), true);
    capture.add(datagram_of(pdu), kStart + seconds(i));
  }
  EXPECT_EQ(check(capture.path()).codes()["W-TIMESTAMP-TOLERANCE"], 2);
}

TEST(InspectCheck, HoldsRelativeTimestampsAgainstTheArrival) {
  for (const bool drifts : {false, true}) {
    CaptureBuilder capture;
    for (int i = 0; i < 20; ++i) {
      pdu::EntityState pdu = truck(seconds(i));
      // Counts from its own origin, across the end of its hour, 1.5 times too fast or right.
      const nanoseconds told = seconds(3590) + milliseconds(i * (drifts ? 1500 : 1000));
      pdu.header.timestamp = pdu::to_dis_timestamp(told, false);
      pdu.linear_velocity.y = drifts ? 10.0F / 1.5F : 10.0F;
      capture.add(datagram_of(pdu), kStart + seconds(i));
    }
    EXPECT_EQ(check(capture.path()).codes()["W-TIMESTAMP-TOLERANCE"], drifts ? 1 : 0);
  }
}

TEST(InspectCheck, ReportsUnixSecondsInTimestampsOnce) {
  CaptureBuilder capture;
  for (int i = 0; i < 12; ++i) {
    pdu::EntityState pdu = truck(seconds(i));
    pdu.header.timestamp = static_cast<std::uint32_t>(1'700'000'000 + i);
    capture.add(datagram_of(pdu), kStart + seconds(i));
  }
  const Checked checked = check(capture.path());
  EXPECT_EQ(checked.codes(), (std::map<std::string, int>{{"W-TIMESTAMP-PACE", 1}}));
  EXPECT_THAT(checked.findings[0]["reason"].get<std::string>(), HasSubstr("seconds since 1970"));
  EXPECT_THAT(checked.findings[0]["remedy"].get<std::string>(), testing::Not(HasSubstr("NTP")));
}

TEST(InspectCheck, CountsCopiesOfOneSenderAtTheEnd) {
  const auto notes_of = [](milliseconds later, Sender second) {
    CaptureBuilder capture;
    for (int i = 0; i < 10; ++i) {
      capture.add(datagram_of(truck(seconds(i))), kStart + seconds(i));
      capture.add(datagram_of(truck(seconds(i))), kStart + seconds(i) + later, second);
    }
    std::vector<json> notes = check(capture.path()).findings;
    std::erase_if(notes, [](const json& finding) { return finding["rule"] != "I-COPIES"; });
    return notes;
  };
  const auto notes = notes_of(milliseconds(1), Sender{});
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0]["frame"], 2);
  EXPECT_EQ(notes[0]["reason"],
            "10 of 20 datagrams are copies; the first repeats frame 1 after 1.000 ms");
  EXPECT_THAT(notes[0]["remedy"].get<std::string>(), HasSubstr("editcap"));
  EXPECT_TRUE(notes_of(milliseconds(6), Sender{}).empty()) << "it may be sent again";
  EXPECT_TRUE(notes_of(milliseconds(1), Sender{2, 3000, 0}).empty()) << "a bridge";
}

TEST(InspectCheck, ChecksPdusWithTrailingOctets) {
  CaptureBuilder capture;
  pdu::EntityState pdu = truck(seconds(0));
  pdu.force_id = pdu::ForceId{77};
  Octets datagram = datagram_of(pdu);
  datagram.resize(160, std::byte{0x11});
  datagram[9] = std::byte{160};
  capture.add(datagram, kStart);
  EXPECT_EQ(check(capture.path()).codes(),
            (std::map<std::string, int>{{"W-SIDE", 1}, {"W-TRAILING", 1}}));
}

TEST(InspectCheck, ReportsSilenceUnlessAfterAFarewell) {
  for (const bool goodbye : {false, true}) {
    CaptureBuilder capture;
    pdu::EntityState plane = truck(seconds(0));
    plane.entity_id.entity = 9;
    plane.entity_type.domain = pdu::EntityDomain::air;
    if (goodbye) plane.appearance = pdu::kAppearanceDeactivated;
    capture.add(datagram_of(plane), kStart);
    capture.add(datagram_of(truck(seconds(13))), kStart + seconds(13));
    const Checked checked = check(capture.path());
    ASSERT_EQ(checked.findings.size(), goodbye ? 0U : 1U);
    if (goodbye) continue;
    EXPECT_EQ(checked.findings[0]["id"], "1:2:9");
    EXPECT_EQ(checked.findings[0]["reason"],
              "1:2:9 silent for 13.000 s, its heartbeat is 5 s, until the end");
  }
}

TEST(InspectCheck, TakesARestartForNoDuplicate) {
  CaptureBuilder capture;
  drive(capture);
  for (int i = 4; i < 8; ++i)
    capture.add(datagram_of(truck(seconds(i))), kStart + seconds(i), Sender{1, 4000, 0});
  EXPECT_TRUE(check(capture.path()).findings.empty());
  capture.add(datagram_of(truck(seconds(8))), kStart + seconds(8), Sender{1, 3000, 0});
  EXPECT_EQ(check(capture.path()).codes()["W-DUPLICATE-ID"], 1);
}

TEST(InspectCheck, TakesSharpTurnsAndJumpsForNoContradiction) {
  CaptureBuilder capture;
  double y = 0;
  for (int i = 0; i < 40; ++i) {
    pdu::EntityState pdu = truck(seconds(i));
    const float velocity = i / 10 % 2 == 0 ? 10.0F : -10.0F;  // turns back every ten seconds
    pdu.linear_velocity = {0, velocity, 0};
    if (i == 25) y += 500;
    pdu.location.y = y;
    y += velocity;
    capture.add(datagram_of(pdu), kStart + seconds(i));
  }
  EXPECT_EQ(check(capture.path()).codes(), (std::map<std::string, int>{{"W-TELEPORT", 1}}));
}

TEST(InspectCheck, ReadsVelocityInBodyAxes) {
  CaptureBuilder capture;
  for (int i = 0; i < 8; ++i) {
    pdu::EntityState pdu = truck(seconds(i));
    pdu.dead_reckoning.algorithm = pdu::DeadReckoningAlgorithm::fpb;
    pdu.linear_velocity = {10, 0, 0};
    pdu.orientation.psi = 1.5707963F;  // the body's x axis along the world's y axis
    capture.add(datagram_of(pdu), kStart + seconds(i));
  }
  EXPECT_TRUE(check(capture.path()).findings.empty());
}

TEST(InspectCheck, ReportsItsMemoryLimit) {
  CheckView view(Format::json, false, 2);
  DatagramInspector inspector;
  std::string out;
  for (std::uint16_t entity = 1; entity <= 5; ++entity) {
    pdu::EntityState pdu = truck(seconds(0));
    pdu.entity_id.entity = entity;
    const Octets octets = datagram_of(pdu);
    peer::SourceDatagram datagram;
    datagram.frame = entity;
    datagram.bytes = octets;
    view.expect(datagram);
    (void)inspector.inspect(datagram, [&](const PduRow& row) {
      view.pdu(datagram, row, {}, out);
      return true;
    });
  }
  EXPECT_EQ(view.count(PduStatus::note), 1U);
  EXPECT_THAT(out, HasSubstr("I-ENTITY-LIMIT"));
  EXPECT_EQ(json::parse(out)["frame"], 3);
}

TEST(InspectCheck, FindsOnlyTheCutDatagramInRecordedSessions) {
  RECKON_NEED_DATA("dis-captures/real-sessions");
  const auto folder = test::reference_data() / "dis-captures/real-sessions";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    SCOPED_TRACE(entry.path());
    const bool cut = entry.path().filename().string().starts_with("turn90");
    const Checked checked = check(entry.path());
    auto codes = checked.codes();
    EXPECT_EQ(codes["E-TRUNCATED"], cut ? 1 : 0);
    for (const auto& [code, count] : codes)
      EXPECT_TRUE(code == "E-TRUNCATED" || code == "I-UNKNOWN-TYPE") << code << " x " << count;
  }
}

/// A recorded session with the velocity of every Entity State multiplied by `factor`.
void scale_velocities(const std::string& path, float factor, CaptureBuilder& capture) {
  const auto source = peer::open_capture(path);
  peer::SourceDatagram datagram;
  while (source->next(datagram, {}) == peer::SourceEvent::datagram) {
    Octets octets(datagram.bytes.begin(), datagram.bytes.end());
    pdu::EntityState state;
    if (decode(octets, state) == pdu::DecodeError::none) {
      state.linear_velocity.x *= factor;
      state.linear_velocity.y *= factor;
      state.linear_velocity.z *= factor;
      ASSERT_GT(encode(state, octets), 0U);
    }
    capture.add(octets, datagram.time);
  }
}

TEST(InspectCheck, FindsWrongUnitsAndSignsOfRecordedVelocities) {
  RECKON_NEED_DATA("dis-captures/real-sessions");
  const auto folder = test::reference_data() / "dis-captures/real-sessions";
  for (const char* name : {"gaz69-patrol.pcap", "gaz69-straight.pcap", "gaz69-single-block.pcap"}) {
    for (const float factor : {1.0F, 3.6F, 1 / 3.6F, -1.0F, 0.0F}) {
      SCOPED_TRACE(std::string(name) + " x " + std::to_string(factor));
      CaptureBuilder capture;
      scale_velocities(folder / name, factor, capture);
      EXPECT_EQ(check(capture.path()).codes()["W-VELOCITY"] > 0, factor != 1.0F);
    }
  }
}

}  // namespace
}  // namespace reckon::tools::check_view_test
