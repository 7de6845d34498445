// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon inspect` on datagrams of the test: the lines that other tools rely on, octet for octet.
#include <gmock/gmock.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "reckon/pdu/pdu_types.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/network/udp_multicast.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"

namespace reckon::tools {
namespace {

using nlohmann::json;
using test::run_reckon;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

using Octets = std::vector<std::byte>;

/// A file that is removed at the end of its scope.
class TemporaryFile {
 public:
  explicit TemporaryFile(const Octets& octets)
      : path_(std::filesystem::temp_directory_path() /
              ("reckon-tools-test-" + std::to_string(getpid()) + "-" + std::to_string(++number_))) {
    std::ofstream file(path_, std::ios::binary);
    file.write(reinterpret_cast<const char*>(octets.data()),
               static_cast<std::streamsize>(octets.size()));
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  [[nodiscard]] std::string path() const { return path_.string(); }
  [[nodiscard]] std::string raw() const { return "raw:" + path_.string(); }

 private:
  static inline int number_ = 0;
  std::filesystem::path path_;
};

template <typename Pdu>
void append(Octets& datagram, const Pdu& pdu) {
  const std::size_t begin = datagram.size();
  datagram.resize(begin + wire_size(pdu));
  ASSERT_GT(encode(pdu, std::span(datagram).subspan(begin)), 0U);
}

pdu::EntityState sample_entity() {
  pdu::EntityState pdu;
  pdu.entity_id = {1, 2, 3};
  pdu.force_id = pdu::ForceId::friendly;
  pdu.location = {4336565.2154, -2958480.5876, 0.1};
  pdu.dead_reckoning.algorithm = pdu::DeadReckoningAlgorithm::rvw;
  pdu.marking.set("HAND");
  return pdu;
}

/// An Entity State and, coupled to it, a force model and an energy account.
Octets haptic_datagram() {
  Octets datagram;
  pdu::EntityState entity = sample_entity();
  entity.header.pdu_status = pdu::kStatusCoupledExtension;
  append(datagram, entity);

  std::array<std::byte, 512> buffer{};
  pdu::AttributeWriter writer(buffer, pdu::Attribute{});
  pdu::HapticRecord model;
  model.kind = pdu::ForceModelKind::sphere;
  model.validity_ms = 12000;
  model.k1 = 800.0F;
  model.damping = 2.0F;
  model.static_friction = 0.4F;
  model.kinetic_friction = 0.3F;
  model.radius = 0.02F;
  pdu::EnergyAccountRecord account;
  account.counterpart = {4, 5, 6};
  account.given = 0.0125;
  account.need = 500;
  EXPECT_TRUE(writer.begin_set({1, 2, 3}) && writer.add(model) && writer.add(account));
  const std::size_t size = writer.finish();
  datagram.insert(datagram.end(), buffer.begin(),
                  buffer.begin() + static_cast<std::ptrdiff_t>(size));
  return datagram;
}

TEST(InspectJson, WritesAnEntityStateWithTheFixedKeys) {
  Octets datagram;
  append(datagram, sample_entity());
  const TemporaryFile file(datagram);
  const auto result = run_reckon({"inspect", file.raw(), "--json"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(
      result.out,
      R"({"frame":1,"pdu":1,"offset":0,"time":0.000000000,"type":"entity_state",)"
      R"("type_number":1,"length":144,"status":"ok","id":"1:2:3","marking":"HAND","force_id":1,)"
      R"("location":[4336565.215,-2958480.588,0.100],"latitude":0.000001100,)"
      R"("longitude":-34.302491798,"height":-1128526.990,"drm":4})"
      "\n");
  EXPECT_THAT(result.err, EndsWith("1 PDU in 1 datagram: 1 good, 0 errors, 0 notes\n"));
}

TEST(InspectJson, WritesForceModelsAndEnergyAccounts) {
  const TemporaryFile file(haptic_datagram());
  const auto lines = run_reckon({"inspect", file.raw(), "--json"}).lines();
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(
      lines[1],
      R"({"frame":1,"pdu":2,"offset":144,"time":0.000000000,"type":"attribute","type_number":72,)"
      R"("length":136,"status":"ok","id":"1:2:3","haptic":[{"id":"1:2:3","record_type":1212239873,)"
      R"("record_length":72,"version":1,"kind":2,"order":0,"flags":0,"surface":0,)"
      R"("validity_ms":12000,"grip_stiffness":0,"k1":800,"k3":0,"damping":2,"mass":0,)"
      R"("point":{"x":0,"y":0,"z":0},"normal":{"x":0,"y":0,"z":0},"static_friction":0.4,)"
      R"("kinetic_friction":0.3,"restitution":0,"radius":0.02}],"energy":[{"id":"1:2:3",)"
      R"("record_type":1212239875,"record_length":24,)"
      R"("counterpart":{"site":4,"application":5,"entity":6},"given":0.0125,"need":500,"spring_need":0}]})");
}

TEST(InspectJson, WritesDoublesThatReadBackExactly) {
  pdu::EntityState pdu = sample_entity();
  pdu.location = {0.1 + 0.2, -1.0 / 3.0, std::numeric_limits<double>::denorm_min()};
  Octets datagram;
  append(datagram, pdu);
  const TemporaryFile file(datagram);
  const json row = json::parse(run_reckon({"inspect", file.raw(), "--full"}).out);
  const json& location = row["fields"]["entity_location"];
  EXPECT_EQ(location["x"].get<double>(), pdu.location.x);
  EXPECT_EQ(location["y"].get<double>(), pdu.location.y);
  EXPECT_EQ(location["z"].get<double>(), pdu.location.z);
}

TEST(InspectJson, FlagsNanAndStaysValidJson) {
  pdu::EntityState pdu = sample_entity();
  pdu.location.y = std::numeric_limits<double>::quiet_NaN();
  pdu.marking.set("\"\\\x01\xff");
  Octets datagram;
  append(datagram, pdu);
  const TemporaryFile file(datagram);
  const auto result = run_reckon({"inspect", file.raw(), "--full"});
  EXPECT_EQ(result.status, 1);
  const json row = json::parse(result.out);
  EXPECT_EQ(row["status"], "warning");
  EXPECT_EQ(row["rule"], "W-NOT-FINITE");
  EXPECT_EQ(row["at"], 56);
  EXPECT_EQ(row["reason"], "entity_location.y is NaN");
  EXPECT_TRUE(row["location"][1].is_null());
  EXPECT_EQ(row["id"], "1:2:3");
}

TEST(InspectJson, FlagsNanInForceModelsWithTheRecord) {
  Octets datagram = haptic_datagram();
  const std::size_t k1 = 144 + 32 + 8 + 16;  // behind Entity State, Attribute, set, record header
  datagram[k1] = std::byte{0x7F};
  datagram[k1 + 1] = std::byte{0xC0};
  const TemporaryFile file(datagram);
  const auto lines = run_reckon({"inspect", file.raw(), "--json"}).lines();
  const json row = json::parse(lines.at(1));
  EXPECT_EQ(row["rule"], "W-NOT-FINITE");
  EXPECT_TRUE(row["haptic"][0]["k1"].is_null());
}

TEST(InspectJson, NamesUnknownTypesAndStepsOverThem) {
  Octets datagram;
  append(datagram, sample_entity());
  append(datagram, sample_entity());
  datagram[2] = std::byte{200};  // the type of the first PDU
  const TemporaryFile file(datagram);
  const auto result = run_reckon({"inspect", file.raw(), "--full"});
  EXPECT_EQ(result.status, 0);
  const auto lines = result.lines();
  ASSERT_EQ(lines.size(), 2U);
  const json first = json::parse(lines[0]);
  EXPECT_EQ(first["type"], "unknown_200");
  EXPECT_EQ(first["type_number"], 200);
  EXPECT_EQ(first["length"], 144);
  EXPECT_EQ(first["status"], "note");
  EXPECT_EQ(first["rule"], "I-UNKNOWN-TYPE");
  EXPECT_EQ(first["fields"]["body"].get<std::string>().size(), 2U * (144 - 12));
  EXPECT_EQ(json::parse(lines[1])["offset"], 144);
}

/// A good PDU, then a NaN, an unknown type, a false count, and a false length at a cut end.
Octets datagram_with_planted_faults() {
  constexpr std::size_t kSize = 144;
  Octets datagram;
  for (std::uint16_t entity = 1; entity <= 5; ++entity) {
    pdu::EntityState pdu = sample_entity();
    pdu.entity_id.entity = entity;
    if (entity == 2 || entity == 5) pdu.location.x = std::numeric_limits<double>::quiet_NaN();
    append(datagram, pdu);
  }
  datagram[2 * kSize + 2] = std::byte{220};   // type
  datagram[3 * kSize + 19] = std::byte{200};  // number of variable parameters
  datagram[4 * kSize + 8] = std::byte{0x25};  // length 9472 + 144
  datagram.resize(4 * kSize + 70);            // behind its location.x
  return datagram;
}

TEST(InspectJson, NamesEachInjectedFaultOfABundle) {
  const TemporaryFile file(datagram_with_planted_faults());
  const auto result = run_reckon({"inspect", file.raw(), "--json"});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, EndsWith("5 PDUs in 1 datagram: 1 good, 2 errors, 1 warning, 1 note\n"));
  struct Expected {
    const char* rule;
    int at;
    const char* reason;
    const char* id;
  };
  constexpr std::array kExpected{
      Expected{"W-NOT-FINITE", 144 + 48, "entity_location.x is NaN", "1:2:2"},
      Expected{"I-UNKNOWN-TYPE", 288 + 2,
               "144 octets kept unchanged: no field table for PDU type 220", nullptr},
      Expected{"E-COUNT", 432 + 19,
               "number_of_variable_parameter_records 200 need 3200 octets, 0 remain", "1:2:4"},
      Expected{"E-TRUNCATED", 576 + 70,
               "length field: 9616 octets, 70 remain; ends inside entity_location.z", "1:2:5"}};
  const auto lines = result.lines();
  ASSERT_EQ(lines.size(), 5U);
  for (std::size_t i = 0; i < kExpected.size(); ++i) {
    const json row = json::parse(lines[i + 1]);
    EXPECT_EQ(row["rule"], kExpected[i].rule);
    EXPECT_EQ(row["at"], kExpected[i].at);
    EXPECT_EQ(row["reason"], kExpected[i].reason);
    EXPECT_EQ(row.contains("id"), kExpected[i].id != nullptr);
    if (row.contains("id")) {
      EXPECT_EQ(row["id"], kExpected[i].id);
    }
  }
}

TEST(InspectJson, ShowsTheOctetsOfADatagramWithoutHeader) {
  const TemporaryFile file(Octets{std::byte{7}, std::byte{1}, std::byte{0xAB}});
  const auto result = run_reckon({"inspect", file.raw(), "--full"});
  EXPECT_EQ(result.status, 1);
  const json row = json::parse(result.out);
  EXPECT_EQ(row["type"], "unreadable");
  EXPECT_EQ(row["rule"], "E-TRUNCATED");
  EXPECT_EQ(row["fields"]["body"], "0701ab");
}

TEST(InspectTail, ShowsForceModelAndEnergyInOneLine) {
  const TemporaryFile file(haptic_datagram());
  const auto lines = run_reckon({"inspect", file.raw(), "tail"}).lines();
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_THAT(lines[0], HasSubstr("FRAME PDU OFFSET"));
  EXPECT_THAT(
      lines[1],
      HasSubstr("HAND  Other Other  Friendly  DRM RVW  (4336565.215, -2958480.588, 0.100) m"));
  EXPECT_THAT(
      lines[2],
      HasSubstr("1 set, 2 records; Sphere k1 800 N/m b 2 N s/m mu 0.4/0.3 r 0.02 m valid 12 s"));
  EXPECT_THAT(lines[2], HasSubstr("gave 4:5:6 0.0125 J, needs 0.0005 J"));
}

TEST(InspectTail, UsesColourOnlyWhereTheTerminalTakesIt) {
  const TemporaryFile file(Octets(3));
  EXPECT_THAT(run_reckon({"inspect", file.raw()}).out, ::testing::Not(HasSubstr("\x1b[")));
}

TEST(InspectTail, ShowsMarkingsWithoutControlCharacters) {
  pdu::EntityState pdu = sample_entity();
  pdu.marking.set("A\x1b[31mB");
  Octets datagram;
  append(datagram, pdu);
  const TemporaryFile file(datagram);
  EXPECT_THAT(run_reckon({"inspect", file.raw()}).out, HasSubstr("A.[31mB"));
}

TEST(InspectTail, NamesTheTypeOfAnEntityInWords) {
  pdu::EntityState pdu = sample_entity();
  pdu.entity_type = {pdu::EntityKind::platform, pdu::EntityDomain::land, 225, 1, 0, 0, 0};
  pdu.force_id = pdu::ForceId{77};
  Octets datagram;
  append(datagram, pdu);
  const TemporaryFile file(datagram);
  EXPECT_THAT(run_reckon({"inspect", file.raw()}).out,
              HasSubstr("  Platform Land United States Tank  side 77  DRM RVW  ("));
  const auto line = run_reckon({"inspect", file.raw(), "--json"}).out;
  EXPECT_THAT(line, ::testing::Not(HasSubstr("_name")));
  EXPECT_LE(line.size(), 330U);
  EXPECT_THAT(run_reckon({"inspect", file.raw(), "--json", "--full"}).out,
              HasSubstr(R"("country":225,"country_name":"United States")"));
}

TEST(InspectTree, ShowsEveryFieldOfTheTable) {
  const TemporaryFile file(haptic_datagram());
  const auto result = run_reckon({"inspect", file.raw(), "--tree"});
  EXPECT_THAT(result.out, StartsWith("frame 1 PDU 1 +0  entity_state  144 octets\n  header "));
  for (const char* field : {"entity_location x 4336565.2154", "entity_marking_string \"HAND\"",
                            "dead_reckoning_algorithm 4 (DRM RVW)", "k1 800", "given 0.0125"})
    EXPECT_THAT(result.out, HasSubstr(field));
}

TEST(InspectRun, EndsAfterTheCountAskedFor) {
  const TemporaryFile file(haptic_datagram());
  const auto result = run_reckon({"inspect", file.raw(), "--json", "--count", "1"});
  EXPECT_EQ(result.lines().size(), 1U);
  EXPECT_THAT(result.err, HasSubstr("1 PDU in 1 datagram"));
}

TEST(InspectRun, RefusesUnreadableFiles) {
  EXPECT_EQ(run_reckon({"inspect", "/no/such/file.pcap"}).status, 2);
  EXPECT_EQ(run_reckon({"inspect", "raw:/no/such/file"}).status, 2);
  const TemporaryFile file(Octets(100));
  const auto result = run_reckon({"inspect", file.path()});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr(file.path()));
  EXPECT_TRUE(result.out.empty());
}

TEST(InspectRun, RefusesInvalidGroups) {
  for (const char* wrong : {"udp://", "udp://239.192.1.0:99999", "udp://nowhere"})
    EXPECT_EQ(run_reckon({"inspect", wrong}).status, 2) << wrong;
  EXPECT_EQ(run_reckon({"inspect", "udp://239.255.255.255", "--pool", "2"}).status, 2);
  EXPECT_EQ(run_reckon({"inspect", "udp://198.51.100.1"}).status, 3)
      << "an address of no interface";
  const TemporaryFile file(Octets(12));
  EXPECT_EQ(run_reckon({"inspect", file.raw(), "--iface", "lo"}).status, 2);
}

TEST(InspectRun, ReportsAMissingInterface) {
  const auto result = run_reckon({"inspect", "--iface", "no-such-interface", "--for", "1s"});
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(result.err, HasSubstr("no-such-interface"));
}

TEST(InspectRun, ComesToAGoodEndAfterCtrlC) {
  const std::atomic<bool> stop{true};
  const TemporaryFile file(Octets(3));
  EXPECT_EQ(run_reckon({"inspect", file.raw()}, &stop).status, 0);
}

TEST(InspectLive, ReceivesAGroupOnLoopback) {
  const std::string group = "239.192.77.9:" + std::to_string(20000 + getpid() % 20000);
  Octets datagram;
  append(datagram, sample_entity());
  const peer::SteadyClock clock;
  peer::UdpMulticastOptions options;
  options.interface = "lo";
  peer::UdpMulticast link(options, clock);

  std::atomic<bool> heard{false};
  test::ProgramResult result;
  std::thread listener([&] {
    result = run_reckon(
        {"inspect", "udp://" + group, "--iface", "lo", "--json", "--count", "3", "--for", "10s"});
    heard = true;
  });
  while (!heard) {
    EXPECT_TRUE(link.send(*peer::IpEndpoint::parse(group), datagram));
    (void)link.wait(std::chrono::milliseconds(5));
  }
  listener.join();
  EXPECT_EQ(result.status, 0) << result.err;
  const auto lines = result.lines();
  ASSERT_EQ(lines.size(), 3U) << result.err;
  const json row = json::parse(lines[0]);
  EXPECT_EQ(row["id"], "1:2:3");
  EXPECT_GT(row["time"].get<double>(), 1.6e9);
  EXPECT_THAT(result.err, HasSubstr("0 lost before they reached this program"));
}

}  // namespace
}  // namespace reckon::tools
