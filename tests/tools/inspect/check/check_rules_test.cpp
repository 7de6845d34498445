// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The rules of `reckon inspect check`: each reports its injected fault and nothing else, with a
// remedy.
#include <gmock/gmock.h>

#include <array>
#include <limits>
#include <set>
#include <string>
#include <utility>

#include "reckon/pdu/entity/attribute.hpp"
#include "reckon/pdu/entity/variable_parameter.hpp"
#include "reckon/pdu/reckon/datagram_trailer.hpp"
#include "reckon/tests/tools/support/checked_traffic.hpp"
#include "reckon/tools/inspect/check/check_view.hpp"

namespace reckon::tools::check_rules_test {
namespace {

using namespace checks;
using nlohmann::json;
using test::Sender;
using ::testing::HasSubstr;

struct Planted {
  const char* code;
  Plant plant;
};

/// Injects a fault into the octets of a datagram.
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

/// Two updates 500 m beside the path.
void plant_teleport(CaptureBuilder& capture) {
  for (int i = 4; i < 6; ++i) {
    pdu::EntityState pdu = truck(seconds(i));
    pdu.location.z += 500;
    capture.add(datagram_of(pdu), kStart + seconds(i));
  }
}

/// The same for one update.
void plant_spike(CaptureBuilder& capture) {
  for (int i = 4; i < 6; ++i) {
    pdu::EntityState pdu = truck(seconds(i));
    pdu.location.z += i == 4 ? 500 : 0;
    capture.add(datagram_of(pdu), kStart + seconds(i));
  }
}

void plant_other_host(CaptureBuilder& capture) {
  capture.add(datagram_of(truck(seconds(4))), kStart + seconds(4), Sender{2, 3000, 0});
  capture.add(datagram_of(truck(seconds(5))), kStart + seconds(5));
  capture.add(datagram_of(truck(seconds(6))), kStart + seconds(6), Sender{2, 3000, 0});
}

constexpr std::uint32_t kOwner = 77;

/// A body of a scene at second `i` from a peer with epoch kOwner; 0: without a record of `owner`.
Octets body_at(int i, std::uint32_t owner, std::uint64_t version = 1) {
  pdu::EntityState pdu = truck(seconds(i));
  pdu.entity_id = {65534, 1, 1};
  Octets datagram;
  if (owner != 0) pdu.header.pdu_status = pdu::kStatusCoupledExtension;
  append_pdu(datagram, pdu);
  if (owner != 0) {
    std::array<std::byte, 128> buffer;
    pdu::AttributeWriter writer(buffer, {});
    pdu::OwnershipRecord record;
    record.owner = owner;
    record.version = version;
    EXPECT_TRUE(writer.begin_set(pdu.entity_id) && writer.add(record));
    const auto attribute = std::span(buffer).first(writer.finish());
    datagram.insert(datagram.end(), attribute.begin(), attribute.end());
  }
  pdu::DatagramTrailer trailer;
  trailer.epoch = kOwner;
  append_pdu(datagram, trailer);
  return datagram;
}

/// A truck whose timestamp stays constant from its fourth second on.
void plant_still_stamps(CaptureBuilder& capture) {
  for (int i = 4; i < 10; ++i) {
    pdu::EntityState pdu = truck(seconds(i));
    pdu.header.timestamp = truck(seconds(3)).header.timestamp;
    capture.add(datagram_of(pdu), kStart + seconds(i));
  }
}

/// Another truck whose timestamps count milliseconds.
void plant_milliseconds(CaptureBuilder& capture) {
  for (int i = 4; i < 10; ++i) {
    pdu::EntityState pdu = truck(seconds(i));
    pdu.entity_id.entity = 5;
    pdu.header.timestamp = static_cast<std::uint32_t>(1000 * i);
    capture.add(datagram_of(pdu), kStart + seconds(i));
  }
}

/// An articulated part whose value is a float64.
void plant_float64(CaptureBuilder& capture) {
  std::array<std::byte, pdu::kVariableParameterSize> part{};
  pdu::ArticulatedPart fields;
  fields.parameter_type = 4107;
  EXPECT_EQ(store_record(fields, part), part.size());
  pdu::store_big_endian(part.data() + 8, 0.785398);
  pdu::EntityState pdu = truck(seconds(4));
  pdu.variable_parameters = part;
  capture.add(datagram_of(pdu), kStart + seconds(4));
}

void plant_large_pdu(CaptureBuilder& capture) {
  Octets datagram = datagram_of(truck(seconds(4)));
  datagram.resize(9000);
  datagram[8] = std::byte{9000 >> 8};
  datagram[9] = std::byte{9000 & 0xFF};
  capture.add(datagram, kStart + seconds(4));
}

std::vector<Planted> planted_errors() {
  return {
      {"E-TRUNCATED", in_octets([](Octets& o) { o.resize(140); })},
      {"E-LENGTH", in_octets([](Octets& o) { o[9] = std::byte{8}; })},
      {"E-BYTE-ORDER", in_octets([](Octets& o) { std::swap(o[8], o[9]); })},
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
  };
}

std::vector<Planted> planted_values() {
  return {
      {"W-NOT-FINITE",
       in_fields([](auto& pdu) { pdu.location.y = std::numeric_limits<double>::quiet_NaN(); })},
      {"W-TRAILING", in_octets([](Octets& o) {
         o.resize(150, std::byte{0x55});
         o[9] = std::byte{150};
       })},
      {"W-STATIC-MOVES", in_fields([](auto& pdu) {
         pdu.dead_reckoning.algorithm = pdu::DeadReckoningAlgorithm::static_;
       })},
      {"W-DRM", in_fields([](auto& pdu) {
         pdu.dead_reckoning.algorithm = pdu::DeadReckoningAlgorithm{10};
       })},
      {"W-SIDE", in_fields([](auto& pdu) { pdu.force_id = pdu::ForceId{31}; })},
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
  };
}

std::vector<Planted> planted_courses() {
  return {
      {"W-TIMESTAMP-ORDER", in_fields([](auto& pdu) {
         pdu.header.timestamp = pdu::to_dis_timestamp(kStart + seconds(1), true);
       })},
      {"W-TIMESTAMP-TOLERANCE", in_fields([](auto& pdu) {
         pdu.header.timestamp = pdu::to_dis_timestamp(kStart + seconds(12), true);
       })},
      {"W-TIMESTAMP-STILL", plant_still_stamps},
      {"W-TIMESTAMP-PACE", plant_milliseconds},
      {"W-HEARTBEAT", [](CaptureBuilder& capture) { drive(capture, seconds(300)); }},
      {"W-DUPLICATE-ID", plant_other_host},
      {"W-VELOCITY", plant_kilometres_per_hour},
      {"W-ORIENTATION", in_fields([](auto& pdu) { pdu.orientation.psi = 90; })},
      {"W-FLOAT64", plant_float64},
      {"W-TELEPORT", plant_teleport},
      {"W-SPIKE", plant_spike},
      {"W-ATTRIBUTE-ORDER",
       [](CaptureBuilder& capture) {
         Octets datagram = attribute();
         join(datagram, datagram_of(truck(seconds(4))));
         capture.add(datagram, kStart + seconds(4));
       }},
      {"W-COUPLED",
       in_fields([](auto& pdu) { pdu.header.pdu_status = pdu::kStatusCoupledExtension; })},
      {"W-OWNER", [](CaptureBuilder& capture) { capture.add(body_at(4, 0), kStart + seconds(4)); }},
      {"I-UNKNOWN-TYPE", in_octets([](Octets& o) { o[2] = std::byte{222}; })},
      {"I-FOREIGN",
       [](CaptureBuilder& capture) {
         for (int i = 0; i < 3; ++i)  // reported once
           capture.add(Octets(40, std::byte{0}), kStart + seconds(4 + i));
       }},
      {"I-COPIES",
       [](CaptureBuilder& capture) {
         for (int i = 0; i < 6; ++i)
           capture.add(datagram_of(truck(seconds(4 + i / 2))),
                       kStart + seconds(4 + i / 2) + milliseconds(i % 2));
       }},
      {"I-BUNDLE-ORDER",
       [](CaptureBuilder& capture) {
         Octets datagram;
         append_pdu(datagram, pdu::Comment{});
         join(datagram, datagram_of(truck(seconds(4))));
         capture.add(datagram, kStart + seconds(4));
       }},
  };
}

const std::vector<Planted>& planted() {
  static const std::vector<Planted> kPlanted = [] {
    std::vector<Planted> all = planted_errors();
    for (const auto& more : {planted_values(), planted_courses()})
      all.insert(all.end(), more.begin(), more.end());
    return all;
  }();
  return kPlanted;
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

/// Faults that inevitably break a second rule.
const std::map<std::string, std::set<std::string>> kAlso{{"W-ATTRIBUTE-ORDER", {"I-BUNDLE-ORDER"}},
                                                         {"W-SIZE", {"W-TRAILING"}}};

TEST(InspectCheck, EachRuleReportsItsFaultOnlyAndOnce) {
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

TEST(InspectCheck, BodiesMayChangeTheirOwner) {
  const auto codes_of = [](const std::function<Octets(int)>& body) {
    CaptureBuilder capture;
    for (int i = 4; i < 8; ++i)
      capture.add(body(i), kStart + seconds(i),
                  Sender{static_cast<std::uint8_t>(1 + i % 2), 3000, 0});
    return check(capture.path()).codes();
  };
  EXPECT_TRUE(codes_of([](int i) {
                return body_at(i, kOwner, static_cast<std::uint64_t>(10 + i));
              }).empty());
  EXPECT_EQ(codes_of([](int i) { return body_at(i, kOwner); })["W-DUPLICATE-ID"], 1);
  EXPECT_EQ(codes_of([](int i) {
              return body_at(i, kOwner + 1, static_cast<std::uint64_t>(10 + i));
            })["W-OWNER"],
            4);
}

TEST(InspectCheck, NamesTheOctetOfTheField) {
  // As IEEE 1278.1 lays out an Entity State PDU.
  const std::map<std::string, int> octets{{"W-FAMILY", 3},
                                          {"W-TIMESTAMP-ORDER", 4},
                                          {"W-TIMESTAMP-TOLERANCE", 4},
                                          {"W-SIZE", 8},
                                          {"W-COUPLED", 10},
                                          {"W-ID", 12},
                                          {"W-OWNER", 12},
                                          {"E-BYTE-ORDER", 8},
                                          {"W-TRAILING", 144},
                                          {"W-ORIENTATION", 72},
                                          {"W-FLOAT64", 152},
                                          {"W-TIMESTAMP-STILL", 4},
                                          {"W-TIMESTAMP-PACE", 4},
                                          {"W-SIDE", 18},
                                          {"W-KIND", 20},
                                          {"W-DOMAIN", 21},
                                          {"W-DRM", 88},
                                          {"I-UNNAMED", 22},
                                          {"W-STATIC-MOVES", 36},
                                          {"E-COUNT", 19},
                                          {"W-LOCATION", 48},
                                          {"W-NOT-FINITE", 56}};
  std::size_t compared = 0;
  for (const Planted& fault : planted()) {
    const auto expected = octets.find(fault.code);
    if (expected == octets.end()) continue;
    CaptureBuilder capture;
    drive(capture);
    fault.plant(capture);
    for (const json& finding : check(capture.path()).findings) {
      if (finding["rule"] != fault.code) continue;
      EXPECT_EQ(finding["at"], expected->second) << fault.code;
      ++compared;
    }
  }
  EXPECT_EQ(compared, octets.size());
}

TEST(InspectCheck, EveryRuleHasAnInjectedFault) {
  std::set<std::string_view> rules;
  for (const CheckRule& rule : check_rules()) rules.insert(rule.code);
  EXPECT_EQ(rules.size(), check_rules().size()) << "a code twice";
  for (const Planted& fault : planted()) EXPECT_EQ(rules.erase(fault.code), 1U) << fault.code;
  // E-TYPE is for callers of the codec that request a type; the entity limit has a test of its own.
  // Notes of a lenient reader are tested with it.
  EXPECT_EQ(rules,
            (std::set<std::string_view>{"E-TYPE", "I-ENTITY-LIMIT", "I-NO-LENGTH", "I-TRAILING"}));
}

TEST(InspectCheck, KnowsEveryRuleOfTheCodec) {
  for (std::size_t i = 1; i < pdu::kDecodeErrors; ++i) {
    const auto error = static_cast<pdu::DecodeError>(i);
    EXPECT_NE(find_check_rule(pdu::rule(error)), nullptr) << pdu::rule(error);
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
}  // namespace reckon::tools::check_rules_test
