// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon inspect stats` and `bundles`: sums equal an independent count.
#include "reckon/tools/inspect/views/stats.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "reckon/pdu/pdu_types.hpp"
#include "reckon/pdu/reckon/compressed_states.hpp"
#include "reckon/pdu/reckon/unicast_frame.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/tests/support/capture_builder.hpp"
#include "reckon/tests/support/reference_data.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"

namespace reckon::tools::stats_test {
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

constexpr nanoseconds kStart = seconds(1'700'000'000);

std::vector<json> rows_of(const std::vector<std::string>& arguments) {
  std::vector<json> rows;
  for (const std::string& line : run_reckon(arguments).lines()) rows.push_back(json::parse(line));
  return rows;
}

Octets datagram_with_trailer(std::uint16_t entity, std::uint32_t epoch, std::uint32_t sequence) {
  Octets datagram;
  pdu::EntityState state;
  state.entity_id = {1, 2, entity};
  append_pdu(datagram, state);
  pdu::DatagramTrailer trailer;
  trailer.epoch = epoch;
  trailer.sequence = sequence;
  append_pdu(datagram, trailer);
  return datagram;
}

struct Sum {
  std::uint64_t pdus = 0;
  std::uint64_t octets = 0;
  friend bool operator==(const Sum&, const Sum&) = default;
};
std::ostream& operator<<(std::ostream& out, const Sum& sum) {
  return out << sum.pdus << " PDUs, " << sum.octets << " octets";
}

TEST(InspectStats, SumsEqualTheRowsOfTail) {
  RECKON_NEED_DATA("dis-captures/real-sessions");
  const std::string file =
      test::reference_data() / "dis-captures/real-sessions/gaz69-multi-block-1.pcap";
  std::map<std::string, Sum> types;
  std::map<std::string, Sum> entities;
  Sum all;
  for (const json& row : rows_of({"inspect", file, "--json"})) {
    const auto add = [&](Sum& sum) {
      ++sum.pdus;
      sum.octets += row["length"].get<std::uint64_t>();
    };
    add(types[row["type"]]);
    if (row.contains("id")) add(entities[row["id"]]);
    add(all);
  }
  std::map<std::string, std::map<std::string, Sum>> found;
  json totals;
  for (const json& row : rows_of({"inspect", file, "stats", "--json"})) {
    if (row["by"] == "all") {
      totals = row;
      continue;
    }
    found[row["by"]][row["key"]] = {row["pdus"], row["octets"]};
  }
  EXPECT_EQ(found["type"], types);
  EXPECT_EQ(found["entity"], entities);
  EXPECT_EQ(found["sender"], (std::map<std::string, Sum>{{"10.0.0.1:3000", all}}));
  EXPECT_EQ(found["group"], (std::map<std::string, Sum>{{"239.1.2.3:3000", all}}));
  EXPECT_EQ(totals["pdus"], 2109);
  EXPECT_EQ(totals["datagrams"], 1280);
  EXPECT_EQ(totals["octets"], all.octets);
  EXPECT_EQ(totals["wire_octets"], all.octets + 42 * 1280);
  EXPECT_NEAR(totals["efficiency"].get<double>(),
              static_cast<double>(all.octets) / static_cast<double>(all.octets + 42 * 1280), 1e-5);
  EXPECT_NEAR(totals["pdus_per_datagram"].get<double>(), 2109.0 / 1280.0, 1e-5);
  EXPECT_EQ(totals["with_trailer"], 0);
}

TEST(InspectStats, CountsLossBySenderFromTrailers) {
  CaptureBuilder capture;
  int datagram = 0;
  const auto add = [&](std::uint8_t host, std::uint32_t sequence) {
    capture.add(datagram_with_trailer(host, 100U + host, sequence),
                kStart + milliseconds(100 * datagram++), Sender{host, 3000, 0});
  };
  for (const std::uint32_t sequence : {1U, 2U, 5U, 4U, 4U, 6U}) add(1, sequence);  // 3 is lost
  for (const std::uint32_t sequence : {7U, 8U, 9U}) add(2, sequence);
  const auto rows = rows_of({"inspect", capture.path(), "stats", "--json"});
  std::map<std::string, int> lost;
  for (const json& row : rows) {
    if (row["by"] == "sender") lost[row["key"]] = row["lost"];
  }
  EXPECT_EQ(lost, (std::map<std::string, int>{{"10.0.0.1:3000", 1}, {"10.0.0.2:3000", 0}}));
  const json& totals = rows.back();
  EXPECT_EQ(totals["lost"], 1);
  EXPECT_EQ(totals["late"], 1);
  EXPECT_EQ(totals["duplicated"], 1);
  EXPECT_THAT(run_reckon({"inspect", capture.path(), "stats"}).out,
              HasSubstr("1 lost of 9, 1 late, 1 twice"));
}

// One address receives the numbers of many groups: a frame before each datagram names its group.
TEST(InspectStats, CountsLossPerGroupOfUnicastFrames) {
  CaptureBuilder capture;
  int datagram = 0;
  const auto add = [&](std::uint16_t group, std::uint32_t sequence) {
    pdu::UnicastFrame frame;
    frame.group = group;
    Octets octets;
    append_pdu(octets, frame);
    const Octets behind = datagram_with_trailer(1, 100, sequence);
    octets.insert(octets.end(), behind.begin(), behind.end());
    capture.add(octets, kStart + milliseconds(100 * datagram++), Sender{1, 3000, 0});
  };
  for (const std::uint32_t sequence : {1U, 2U, 4U}) add(0, sequence);  // 3 is lost
  for (const std::uint32_t sequence : {70U, 71U}) add(5, sequence);
  add(0, 5);
  const json totals = rows_of({"inspect", capture.path(), "stats", "--json"}).back();
  EXPECT_EQ(totals["with_trailer"], 6);
  EXPECT_EQ(totals["lost"], 1);
  const auto check = run_reckon({"inspect", capture.path(), "check"});
  EXPECT_THAT(check.out, testing::Not(HasSubstr("BUNDLE-ORDER"))) << "a frame stands in front";
  EXPECT_THAT(check.out, testing::Not(HasSubstr("UNKNOWN-TYPE")));
}

TEST(InspectStats, WritesTheKeysOthersRelyOn) {
  CaptureBuilder capture;
  capture.add(datagram_with_trailer(3, 9, 1), kStart);
  capture.add(datagram_with_trailer(3, 9, 2), kStart + seconds(2));
  const auto lines = run_reckon({"inspect", capture.path(), "stats", "--json"}).lines();
  ASSERT_EQ(lines.size(), 6U);
  EXPECT_EQ(lines[1], R"({"by":"type","key":"entity_state","pdus":2,"octets":288,"pdus_per_s":1,)"
                      R"("octets_per_s":144,"errors":0})");
  EXPECT_EQ(lines[2],
            R"({"by":"sender","key":"10.0.0.1:3000","pdus":4,"octets":336,"pdus_per_s":2,)"
            R"("octets_per_s":168,"errors":0,"datagrams":2,"lost":0})");
  EXPECT_EQ(lines[5],
            R"({"by":"all","pdus":4,"datagrams":2,"seconds":2.000000000,"pdu_octets":336,)"
            R"("octets":336,"wire_octets":420,"errors":0,"pdus_per_s":2,"octets_per_s":168,)"
            R"("pdus_per_datagram":2,"efficiency":0.8,"with_trailer":2,"lost":0,"late":0,)"
            R"("duplicated":0})");
}

TEST(InspectStats, WritesOneTableAsCsv) {
  CaptureBuilder capture;
  capture.add(datagram_with_trailer(3, 9, 1), kStart);
  const auto lines =
      run_reckon({"inspect", capture.path(), "stats", "--by", "entity", "--csv"}).lines();
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0],
            "by,key,pdus,octets,pdus_per_s,octets_per_s,datagrams,errors,lost,jump_max_m,"
            "jump_max_deg");
  EXPECT_EQ(lines[1], "entity,1:2:3,1,144,,,,0,,,");
}

TEST(InspectStats, ShowsTheGreatestJumpsInMetresAndDegrees) {
  CaptureBuilder capture;
  for (int i = 0; i < 4; ++i) {
    pdu::EntityState state;
    state.header.timestamp = pdu::to_dis_timestamp(kStart + seconds(i), true);
    state.entity_id = {1, 2, 3};
    state.location = {6378137.0, i == 2 ? 3.0 : 0.0, 0.0};
    state.orientation.psi = i == 3 ? 0.5F : 0.0F;
    Octets datagram;
    append_pdu(datagram, state);
    capture.add(datagram, kStart + seconds(i));
  }
  const json row = rows_of({"inspect", capture.path(), "stats", "--by", "entity", "--json"})[0];
  EXPECT_NEAR(row["jump_max_m"], 3, 1e-6);
  EXPECT_NEAR(row["jump_max_deg"], 28.6479, 1e-4);
  const auto lines = run_reckon({"inspect", capture.path(), "stats", "--by", "entity"}).lines();
  EXPECT_THAT(lines.back(), HasSubstr("3.00 m    29 deg"));
}

TEST(InspectStats, KeepsMemoryBoundedAndLosesNoPdu) {
  StatsView view(Format::json, "entity", 3);
  std::string out;
  DatagramInspector inspector;
  for (std::uint16_t entity = 1; entity <= 10; ++entity) {
    const Octets octets = datagram_with_trailer(entity, 1, entity);
    peer::SourceDatagram datagram;
    datagram.bytes = octets;
    (void)inspector.inspect(datagram, [&](const PduRow& row) {
      view.pdu(datagram, row, {}, out);
      return true;
    });
    view.datagram(datagram, {}, out);
  }
  view.finish({}, out);
  EXPECT_THAT(out, HasSubstr(R"("key":"others","pdus":7)"));
  EXPECT_EQ(std::count(out.begin(), out.end(), '\n'), 5);
}

TEST(InspectBundles, ShowsOctetsPaddingOrderAndTypes) {
  CaptureBuilder capture;
  Octets good;
  append_pdu(good, pdu::EntityState{});
  append_pdu(good, pdu::EntityState{});
  append_pdu(good, pdu::StartResume{});  // 44 octets
  good.resize(good.size() + 4);          // to the next multiple of 8
  append_pdu(good, pdu::DatagramTrailer{});
  capture.add(good, kStart);
  Octets bad;
  append_pdu(bad, pdu::Comment{});
  append_pdu(bad, pdu::EntityState{});
  bad.resize(bad.size() - 4);
  capture.add(bad, kStart + seconds(1));

  const auto lines = run_reckon({"inspect", capture.path(), "bundles", "--json"}).lines();
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0],
            R"({"frame":1,"time":1700000000.000000000,"source":"10.0.0.1:3000",)"
            R"("group":"239.1.2.3:3000","octets":360,"pdus":4,"pdu_octets":356,"padding":4,)"
            R"("broken_octets":0,"order":"kept",)"
            R"("types":["entity_state","entity_state","start_resume","datagram_trailer"]})");
  const json second = json::parse(lines[1]);
  EXPECT_EQ(second["order"], "broken");
  EXPECT_EQ(second["order_broken_at"], 2);
  EXPECT_EQ(second["broken_octets"], 140);

  const auto text = run_reckon({"inspect", capture.path(), "bundles"});
  EXPECT_EQ(text.status, 1);
  EXPECT_THAT(text.out, HasSubstr("entity_state x2 + start_resume + datagram_trailer\n"));
  EXPECT_THAT(text.out, HasSubstr("broken at 2"));
  EXPECT_EQ(run_reckon({"inspect", capture.path(), "bundles", "--csv"}).lines()[1],
            "1,1700000000.000000000,10.0.0.1:3000,239.1.2.3:3000,360,4,356,4,0,kept,"
            "entity_state x2 + start_resume + datagram_trailer");
}

TEST(InspectBundles, ShowsHowFewOctetsCompressedStatesTake) {
  std::array<std::byte, 256> bodies;
  std::size_t size = 0;
  for (std::uint16_t entity = 1; entity <= 2; ++entity) {
    const std::array<std::byte, 49> body{};
    size += pdu::store_compressed({entity, pdu::CompressedForm::compact, body},
                                  std::span(bodies).subspan(size));
  }
  pdu::CompressedStates states;
  states.number_of_states = 2;
  states.states.bytes = std::span(bodies).first(size);
  Octets octets;
  append_pdu(octets, states);
  CaptureBuilder capture;
  capture.add(octets, kStart);
  // 2 of 144 octets in 20 + 2 (3 + 49).
  EXPECT_THAT(run_reckon({"inspect", capture.path(), "bundles"}).out,
              HasSubstr("compressed_states (2 states, 2.32 to 1)\n"));
  const json row =
      json::parse(run_reckon({"inspect", capture.path(), "bundles", "--json"}).lines()[0]);
  EXPECT_EQ(row["compressed_states"], 2);
  EXPECT_EQ(row["compression"], 2.32);
}

TEST(InspectBundles, CountsEveryDatagramAndPduOfRecordedSessions) {
  RECKON_NEED_DATA("dis-captures/real-sessions");
  const std::string file = test::reference_data() / "dis-captures/real-sessions/gaz69-patrol.pcap";
  const auto rows = rows_of({"inspect", file, "bundles", "--json"});
  EXPECT_EQ(rows.size(), 231U);
  std::size_t pdus = 0;
  for (const json& row : rows) {
    EXPECT_EQ(row["pdus"], row["types"].size());
    EXPECT_EQ(row["pdu_octets"].get<int>() + row["padding"].get<int>(), row["octets"]);
    pdus += row["types"].size();
  }
  EXPECT_EQ(pdus, 383U);
}

TEST(InspectViews, RefuseFlagsOfOtherViewsWithTheRemedy) {
  for (const std::vector<std::string>& wrong :
       {std::vector<std::string>{"inspect", "x.pcap", "--csv"},
        {"inspect", "x.pcap", "stats", "--tree"},
        {"inspect", "x.pcap", "check", "--full"},
        {"inspect", "x.pcap", "check", "--by", "type"},
        {"inspect", "x.pcap", "stats", "--csv", "--json"},
        {"inspect", "x.pcap", "stats", "--by", "nonsense"},
        {"inspect", "x.pcap", "nonsense"}}) {
    const auto result = run_reckon(wrong);
    EXPECT_EQ(result.status, 2) << wrong.back();
    EXPECT_FALSE(result.err.empty());
  }
}

TEST(InspectViews, TakeAViewAloneForTheLiveGroups) {
  const auto result = run_reckon({"inspect", "stats", "--iface", "no-such-interface"});
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(result.err, HasSubstr("no-such-interface"));
}

TEST(InspectViews, AreShownInHelpWithExamples) {
  const auto result = run_reckon({"inspect", "--help"});
  for (const char* part : {"stats", "check", "bundles", "--by", "--csv", "--rules"})
    EXPECT_THAT(result.out, HasSubstr(part));
  EXPECT_THAT(result.out,
              HasSubstr("reckon inspect scenes/exercise.pcapng stats --by entity --csv"));
}

}  // namespace
}  // namespace reckon::tools::stats_test
