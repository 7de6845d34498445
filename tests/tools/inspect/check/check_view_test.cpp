// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon inspect check`: each rule fires on the fault that is planted for it and on nothing else,
// and recorded exercises of a real product give no finding but the datagram that was cut.
#include "reckon/tools/inspect/check/check_view.hpp"

#include <gmock/gmock.h>

#include <array>
#include <functional>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "reckon/pdu/pdu_types.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/peer/capture/capture_file.hpp"
#include "reckon/tests/support/capture_builder.hpp"
#include "reckon/tests/support/reference_data.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"

namespace reckon::tools {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;
using test::append_pdu;
using test::CaptureBuilder;
using test::Octets;
using test::run_reckon;
using test::Sender;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr nanoseconds kStart = seconds(1'700'000'000);

/// Truck 1:2:3 on the ground at latitude 0, driving at 10 m/s, `t` after the start.
pdu::EntityState truck(nanoseconds t) {
  pdu::EntityState pdu;
  pdu.header.timestamp = pdu::to_dis_timestamp(kStart + t, true);
  pdu.entity_id = {1, 2, 3};
  pdu.force_id = pdu::ForceId::friendly;
  pdu.entity_type.kind = pdu::EntityKind::platform;
  pdu.entity_type.domain = pdu::EntityDomain::land;
  pdu.location = {6378137.0, 10.0 * std::chrono::duration<double>(t).count(), 0.0};
  pdu.linear_velocity = {0, 10, 0};
  pdu.dead_reckoning.algorithm = pdu::DeadReckoningAlgorithm::fpw;
  return pdu;
}

Octets datagram_of(const pdu::EntityState& pdu) {
  Octets datagram;
  append_pdu(datagram, pdu);
  return datagram;
}

/// An Attribute PDU of truck 1:2:3 with a force model.
Octets attribute() {
  std::array<std::byte, 256> buffer{};
  pdu::AttributeWriter writer(buffer, pdu::Attribute{});
  pdu::HapticRecord record;
  record.kind = pdu::ForceModelKind::sphere;
  EXPECT_TRUE(writer.begin_set({1, 2, 3}) && writer.add(record));
  const auto size = static_cast<std::ptrdiff_t>(writer.finish());
  return {buffer.begin(), buffer.begin() + size};
}

void join(Octets& datagram, const Octets& more) {
  datagram.insert(datagram.end(), more.begin(), more.end());
}

/// Four good seconds of driving, a coupled datagram among them.
void drive(CaptureBuilder& capture, nanoseconds from = {}) {
  for (int i = 0; i < 4; ++i) {
    const nanoseconds t = from + seconds(i);
    pdu::EntityState pdu = truck(t);
    Octets datagram;
    if (i == 2) pdu.header.pdu_status = pdu::kStatusCoupledExtension;
    append_pdu(datagram, pdu);
    if (i == 2) join(datagram, attribute());
    capture.add(datagram, kStart + t + milliseconds(2));
  }
}

using Plant = std::function<void(CaptureBuilder&)>;
struct Planted {
  const char* code;
  Plant plant;
};

/// A fault made in an Entity State that is good else, four seconds after the start.
Plant in_fields(const std::function<void(pdu::EntityState&)>& change) {
  return [change](CaptureBuilder& capture) {
    pdu::EntityState pdu = truck(seconds(4));
    change(pdu);
    capture.add(datagram_of(pdu), kStart + seconds(4));
  };
}

/// A fault made in the octets of such a datagram.
Plant in_octets(const std::function<void(Octets&)>& change) {
  return [change](CaptureBuilder& capture) {
    Octets datagram = datagram_of(truck(seconds(4)));
    change(datagram);
    capture.add(datagram, kStart + seconds(4));
  };
}

/// Two updates whose velocity is in km/h.
void plant_kilometres_per_hour(CaptureBuilder& capture) {
  for (int i = 4; i < 8; ++i) {
    pdu::EntityState pdu = truck(seconds(i));
    pdu.linear_velocity.y *= 3.6F;
    capture.add(datagram_of(pdu), kStart + seconds(i));
  }
}

void plant_other_host(CaptureBuilder& capture) {
  capture.add(datagram_of(truck(seconds(4))), kStart + seconds(4), Sender{2, 3000, 0});
  capture.add(datagram_of(truck(seconds(5))), kStart + seconds(5));
  capture.add(datagram_of(truck(seconds(6))), kStart + seconds(6), Sender{2, 3000, 0});
}

void plant_large_pdu(CaptureBuilder& capture) {
  Octets datagram = datagram_of(truck(seconds(4)));
  datagram.resize(9000);
  datagram[8] = std::byte{9000 >> 8};
  datagram[9] = std::byte{9000 & 0xFF};
  capture.add(datagram, kStart + seconds(4));
}

const std::vector<Planted>& planted() {
  static const std::vector<Planted> kPlanted{
      {"E-TRUNCATED", in_octets([](Octets& o) { o.resize(140); })},
      {"E-LENGTH", in_octets([](Octets& o) { o[9] = std::byte{8}; })},
      {"E-COUNT", in_octets([](Octets& o) { o[19] = std::byte{200}; })},
      {"E-RECORD",
       [](CaptureBuilder& capture) {
         Octets datagram = attribute();
         datagram[32 + 8 + 4] = datagram[32 + 8 + 5] = std::byte{0};
         capture.add(datagram, kStart + seconds(4));
       }},
      {"E-VERSION", in_octets([](Octets& o) { o[0] = std::byte{9}; })},
      {"E-STRAY", in_octets([](Octets& o) { o.resize(150, std::byte{0x55}); })},
      {"E-FRAGMENT",
       [](CaptureBuilder& capture) {
         capture.add(Octets(100), kStart + seconds(4), Sender{1, 3000, 185});
       }},
      {"W-NOT-FINITE",
       in_fields([](auto& pdu) { pdu.location.y = std::numeric_limits<double>::quiet_NaN(); })},
      {"W-STATIC-MOVES", in_fields([](auto& pdu) {
         pdu.dead_reckoning.algorithm = pdu::DeadReckoningAlgorithm::static_;
       })},
      {"W-DRM", in_fields([](auto& pdu) {
         pdu.dead_reckoning.algorithm = pdu::DeadReckoningAlgorithm{10};
       })},
      {"W-FORCE", in_fields([](auto& pdu) { pdu.force_id = pdu::ForceId{31}; })},
      {"W-KIND", in_fields([](auto& pdu) { pdu.entity_type.kind = pdu::EntityKind{10}; })},
      {"W-DOMAIN", in_fields([](auto& pdu) { pdu.entity_type.domain = pdu::EntityDomain{6}; })},
      {"I-UNNAMED", in_fields([](auto& pdu) {
         pdu.entity_id.entity = 9;
         pdu.entity_type.country = 999;
       })},
      {"W-ID", in_fields([](auto& pdu) { pdu.entity_id.entity = 0xFFFF; })},
      {"W-LOCATION", in_fields([](auto& pdu) {
         pdu.entity_id.entity = 4;
         pdu.location = {100, 200, 0};
       })},
      {"W-SIZE", plant_large_pdu},
      {"W-FAMILY", in_octets([](Octets& o) { o[3] = std::byte{2}; })},
      {"W-TIMESTAMP-ORDER", in_fields([](auto& pdu) {
         pdu.header.timestamp = pdu::to_dis_timestamp(kStart + seconds(1), true);
       })},
      {"W-TIMESTAMP-TOLERANCE", in_fields([](auto& pdu) {
         pdu.header.timestamp = pdu::to_dis_timestamp(kStart + seconds(12), true);
       })},
      {"W-HEARTBEAT", [](CaptureBuilder& capture) { drive(capture, seconds(300)); }},
      {"W-DUPLICATE-ID", plant_other_host},
      {"W-VELOCITY", plant_kilometres_per_hour},
      {"W-ATTRIBUTE-ORDER",
       [](CaptureBuilder& capture) {
         Octets datagram = attribute();
         join(datagram, datagram_of(truck(seconds(4))));
         capture.add(datagram, kStart + seconds(4));
       }},
      {"W-COUPLED",
       in_fields([](auto& pdu) { pdu.header.pdu_status = pdu::kStatusCoupledExtension; })},
      {"I-UNKNOWN-TYPE", in_octets([](Octets& o) { o[2] = std::byte{222}; })},
      {"I-BUNDLE-ORDER",
       [](CaptureBuilder& capture) {
         Octets datagram;
         append_pdu(datagram, pdu::Comment{});
         join(datagram, datagram_of(truck(seconds(4))));
         capture.add(datagram, kStart + seconds(4));
       }},
  };
  return kPlanted;
}

struct Checked {
  int status;
  std::vector<json> findings;
  json summary;

  [[nodiscard]] std::map<std::string, int> codes() const {
    std::map<std::string, int> codes;
    for (const json& finding : findings) ++codes[finding["rule"]];
    return codes;
  }
};

Checked check(const std::string& source) {
  const auto result = run_reckon({"inspect", source, "check", "--json"});
  Checked checked{result.status, {}, {}};
  for (const std::string& line : result.lines()) checked.findings.push_back(json::parse(line));
  checked.summary = checked.findings.back();
  checked.findings.pop_back();
  return checked;
}

TEST(InspectCheck, FindsNothingInGoodTraffic) {
  CaptureBuilder capture;
  drive(capture);
  const Checked checked = check(capture.path());
  EXPECT_TRUE(checked.findings.empty()) << checked.findings.front();
  EXPECT_EQ(checked.status, 0);
  EXPECT_EQ(checked.summary["pdus"], 5);
  EXPECT_EQ(checked.summary["warnings"], 0);
}

/// Faults that break a second rule by their nature.
const std::map<std::string, std::set<std::string>> kAlso{{"W-ATTRIBUTE-ORDER", {"I-BUNDLE-ORDER"}}};

TEST(InspectCheck, FiresEachRuleOnItsFaultAloneAndOnce) {
  for (const Planted& fault : planted()) {
    SCOPED_TRACE(fault.code);
    CaptureBuilder capture;
    drive(capture);
    fault.plant(capture);
    const Checked checked = check(capture.path());
    auto codes = checked.codes();
    EXPECT_EQ(codes[fault.code], 1);
    std::set<std::string> expected{fault.code};
    if (const auto also = kAlso.find(fault.code); also != kAlso.end())
      expected.insert(also->second.begin(), also->second.end());
    for (const auto& [code, count] : codes) EXPECT_TRUE(expected.contains(code)) << code;
    EXPECT_EQ(checked.status, fault.code[0] == 'I' ? 0 : 1);
  }
}

TEST(InspectCheck, HasAPlantedFaultForEveryRuleThatOctetsCanBreak) {
  std::set<std::string_view> rules;
  for (const CheckRule& rule : check_rules()) rules.insert(rule.code);
  EXPECT_EQ(rules.size(), check_rules().size()) << "a code twice";
  for (const Planted& fault : planted()) EXPECT_EQ(rules.erase(fault.code), 1U) << fault.code;
  // E-TYPE is for callers of the codec that ask for a type; the limit has a test of its own.
  EXPECT_EQ(rules, (std::set<std::string_view>{"E-TYPE", "I-ENTITY-LIMIT"}));
}

TEST(InspectCheck, KnowsEveryRuleOfTheCodec) {
  for (std::size_t i = 1; i < pdu::kDecodeErrors; ++i) {
    const auto error = static_cast<pdu::DecodeError>(i);
    EXPECT_NE(find_check_rule(pdu::rule(error)), nullptr) << pdu::rule(error);
  }
}

TEST(InspectCheck, WritesAFindingWithTheKeysOthersRelyOn) {
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
            R"({"rule":"W-FORCE","status":"warning","frame":1,"pdu":2,"offset":32,"at":50,)"
            R"("time":1700000000.000000000,"id":"1:2:3",)"
            R"("reason":"force_id is 77, named are 0 to 30",)"
            R"("sentence":"The force ID has no name.","remedy":"send 0 to 30"})");
  EXPECT_EQ(json::parse(lines[1])["rule"], "I-BUNDLE-ORDER");
  EXPECT_EQ(lines[2],
            R"({"summary":"check","datagrams":1,"pdus":2,"errors":0,"warnings":1,"notes":1,)"
            R"("rules":{"I-BUNDLE-ORDER":1,"W-FORCE":1}})");
}

TEST(InspectCheck, TellsFrameOctetReasonAndRemedyToPeople) {
  CaptureBuilder capture;
  drive(capture);
  in_fields([](auto& pdu) { pdu.dead_reckoning.algorithm = pdu::DeadReckoningAlgorithm{77}; })(
      capture);
  const auto result = run_reckon({"inspect", capture.path(), "check"});
  EXPECT_THAT(result.out,
              StartsWith("frame 5     PDU 1  +88    W-DRM                  1:2:3        "
                         "dead_reckoning_algorithm is 77, named are 0 to 9\n"));
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
            "W-FORCE,1,1,0,18,1700000004.000000000,1:2:3,\"force_id is 99, named are 0 to "
            "30\",send 0 to 30");
}

TEST(InspectCheck, TellsALastingFaultOnceUntilItIsRightAgain) {
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
      // Counts from an origin of its own, across the end of its hour, 1.5 times too fast or right.
      const nanoseconds told = seconds(3590) + milliseconds(i * (drifts ? 1500 : 1000));
      pdu.header.timestamp = pdu::to_dis_timestamp(told, false);
      pdu.linear_velocity.y = drifts ? 10.0F / 1.5F : 10.0F;
      capture.add(datagram_of(pdu), kStart + seconds(i));
    }
    EXPECT_EQ(check(capture.path()).codes()["W-TIMESTAMP-TOLERANCE"], drifts ? 1 : 0);
  }
}

TEST(InspectCheck, TellsOfSilenceUntilTheEndButNotOfWhoSaidGoodbye) {
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

TEST(InspectCheck, TakesARestartFromANewPortForNoDuplicate) {
  CaptureBuilder capture;
  drive(capture);
  for (int i = 4; i < 8; ++i)
    capture.add(datagram_of(truck(seconds(i))), kStart + seconds(i), Sender{1, 4000, 0});
  EXPECT_TRUE(check(capture.path()).findings.empty());
  capture.add(datagram_of(truck(seconds(8))), kStart + seconds(8), Sender{1, 3000, 0});
  EXPECT_EQ(check(capture.path()).codes()["W-DUPLICATE-ID"], 1);
}

TEST(InspectCheck, TakesASharpTurnAndAJumpForNoContradiction) {
  CaptureBuilder capture;
  double y = 0;
  for (int i = 0; i < 40; ++i) {
    pdu::EntityState pdu = truck(seconds(i));
    const float velocity = i / 10 % 2 == 0 ? 10.0F : -10.0F;  // turns back all ten seconds
    pdu.linear_velocity = {0, velocity, 0};
    if (i == 25) y += 500;
    pdu.location.y = y;
    y += velocity;
    capture.add(datagram_of(pdu), kStart + seconds(i));
  }
  EXPECT_TRUE(check(capture.path()).findings.empty());
}

TEST(InspectCheck, ReadsVelocityInBodyAxesWhereTheModelSaysSo) {
  CaptureBuilder capture;
  for (int i = 0; i < 8; ++i) {
    pdu::EntityState pdu = truck(seconds(i));
    pdu.dead_reckoning.algorithm = pdu::DeadReckoningAlgorithm::fpb;
    pdu.linear_velocity = {10, 0, 0};
    pdu.orientation.psi = 1.5707963F;  // the body's x along the world's y
    capture.add(datagram_of(pdu), kStart + seconds(i));
  }
  EXPECT_TRUE(check(capture.path()).findings.empty());
}

TEST(InspectCheck, KeepsMemoryBoundedAndSaysSo) {
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

/// A recorded session with the velocity of every Entity State multiplied.
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

TEST(InspectCheck, FindsWrongUnitsAndSignsOfVelocityInRecordedSessions) {
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

TEST(InspectCheck, ListsItsRulesWithRemedies) {
  const auto result = run_reckon({"inspect", "--rules", "--json"});
  EXPECT_EQ(result.status, 0);
  const auto lines = result.lines();
  ASSERT_EQ(lines.size(), check_rules().size());
  for (const std::string& line : lines) {
    const json row = json::parse(line);
    EXPECT_FALSE(row["sentence"].get<std::string>().empty());
    EXPECT_FALSE(row["remedy"].get<std::string>().empty());
  }
  const auto text = run_reckon({"help", "rules"});
  EXPECT_EQ(text.status, 0);
  EXPECT_THAT(text.out, HasSubstr("W-STATIC-MOVES"));
  EXPECT_EQ(run_reckon({"inspect", "--rules", "--csv"}).lines().size(), check_rules().size() + 1);
}

}  // namespace
}  // namespace reckon::tools
