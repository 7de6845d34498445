// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Other decoders read every PDU that peers send, each alone in a datagram. Skipped where such a
// decoder is not installed.
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include "reckon/pdu/bundle.hpp"
#include "reckon/pdu/management/start_resume.hpp"
#include "reckon/pdu/management/stop_freeze.hpp"
#include "reckon/tests/support/in_process.hpp"
#include "reckon/tests/support/places.hpp"

namespace reckon::test {
namespace {

using Octets = std::vector<std::byte>;

template <pdu::Pdu T>
Octets encoded(const T& message) {
  Octets octets(pdu::wire_size(message));
  EXPECT_EQ(pdu::encode(message, octets), octets.size());
  return octets;
}

// All PDUs of a run in which hands touch, one peer departs, and all are stopped and resumed.
std::vector<Octets> pdus_of_a_run(const peer::SceneFile& scene) {
  InProcess world(3);
  world.listen(scene);
  for (std::size_t link : {0u, 1u, 2u}) world.start(link, scene);
  world.run(3000);
  pdu::StopFreeze stop;
  stop.receiving_entity_id = {0xFFFF, 0xFFFF, 0xFFFF};
  world.say(stop, scene);
  world.run(500);
  pdu::StartResume start;
  start.receiving_entity_id = stop.receiving_entity_id;
  world.say(start, scene);
  world.run(2000);
  world.stop(1);
  world.run(100);

  std::vector<Octets> result;
  for (const Heard& datagram : world.heard()) {
    for (const pdu::BundledPdu& pdu : pdu::BundleReader(datagram.octets)) {
      EXPECT_EQ(pdu.error, pdu::DecodeError::none);
      result.emplace_back(pdu.bytes.begin(), pdu.bytes.end());
    }
  }
  result.push_back(encoded(stop));
  result.push_back(encoded(start));
  return result;
}

std::vector<Octets> all_pdus() {
  std::vector<Octets> all = pdus_of_a_run(managed_by("anyone", scene_of(kTwoHandsOnAWall)));
  const peer::SceneFile interop =
      scene_of(with(kTwoHandsOnAWall, "[hand]",
                    "[network]\ninterop = true\nallow_management = \"anyone\"\n\n[hand]"));
  for (Octets& pdu : pdus_of_a_run(interop)) all.push_back(std::move(pdu));
  return all;
}

int type_of(const Octets& pdu) { return std::to_integer<int>(pdu[2]); }

// Little-endian pcap with Ethernet, IPv4 and UDP headers to port 3000 before each PDU.
void write_pcap(const std::filesystem::path& path, const std::vector<Octets>& pdus) {
  std::ofstream file(path, std::ios::binary);
  const auto put = [&](auto value) {
    file.write(reinterpret_cast<const char*>(&value), sizeof value);
  };
  const auto put_big = [&](std::uint16_t value) {
    file.put(static_cast<char>(value >> 8));
    file.put(static_cast<char>(value & 0xFF));
  };
  for (const std::uint32_t word : {0xA1B2C3D4u, 0x00040002u, 0u, 0u, 65535u, 1u}) put(word);
  std::uint32_t number = 0;
  for (const Octets& pdu : pdus) {
    const auto size = static_cast<std::uint16_t>(pdu.size());
    for (const std::uint32_t word : {1'700'000'000u, number++, size + 42u, size + 42u}) put(word);
    file.write("\x01\x00\x5e\x40\x01\x00\x02\x00\x00\x00\x00\x01\x08\x00\x45\x00", 16);
    put_big(static_cast<std::uint16_t>(size + 28));
    file.write("\x00\x00\x00\x00\x01\x11\x00\x00\x0a\x4d\x00\x01\xef\xc0\x01\x00", 16);
    for (const int word : {40'000, 3000, size + 8, 0}) put_big(static_cast<std::uint16_t>(word));
    file.write(reinterpret_cast<const char*>(pdu.data()), size);
  }
}

struct Outcome {
  int status = -1;
  std::vector<std::string> lines;
};

Outcome run_program(const std::string& command) {
  Outcome outcome;
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return outcome;
  std::array<char, 1024> line{};
  while (std::fgets(line.data(), line.size(), pipe) != nullptr) {
    outcome.lines.emplace_back(line.data());
    outcome.lines.back().erase(outcome.lines.back().find_last_not_of("\r\n") + 1);
  }
  outcome.status = pclose(pipe);
  return outcome;
}

// A file that is removed after the test.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& name)
      : path_(std::filesystem::path(testing::TempDir()) / (name + "." + std::to_string(getpid()))) {
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

TEST(ForeignDecoder, TsharkFlagsNoPduThatIsSent) {
  if (std::system("command -v tshark >/dev/null 2>&1") != 0) {
    GTEST_SKIP() << "needs tshark (Debian: tshark)";
  }
  const std::vector<Octets> pdus = all_pdus();
  std::map<int, std::size_t> by_type;
  for (const Octets& pdu : pdus) ++by_type[type_of(pdu)];
  for (const int type : {1, 13, 14, 15, 72, 140, 141}) EXPECT_GT(by_type[type], 0u) << type;

  const TemporaryFile capture("reckon_pdus.pcap");
  write_pcap(capture.path(), pdus);
  const std::string tshark = "tshark -n -r " + capture.path().string() + " 2>/dev/null ";

  const Outcome protocols = run_program(tshark + "-T fields -e _ws.col.Protocol");
  ASSERT_EQ(protocols.lines.size(), pdus.size()) << "tshark ended with " << protocols.status;
  std::map<int, std::size_t> not_dis;
  for (std::size_t i = 0; i < pdus.size(); ++i) {
    if (protocols.lines[i] != "DIS") ++not_dis[type_of(pdus[i])];
  }
  for (const auto& [type, count] : not_dis) {
    ADD_FAILURE() << count << " PDUs of type " << type << " are not taken for DIS";
  }

  const Outcome flagged = run_program(tshark + "-Y _ws.malformed -T fields -e frame.number");
  ASSERT_EQ(flagged.status, 0);
  std::map<int, std::size_t> malformed;
  for (const std::string& line : flagged.lines) {
    ++malformed[type_of(pdus[std::stoul(line) - 1])];
  }
  for (const auto& [type, count] : malformed) {
    ADD_FAILURE() << count << " of " << by_type[type] << " PDUs of type " << type
                  << " are flagged as malformed";
  }
}

TEST(ForeignDecoder, TsharkReadsTheSentEntityStates) {
  if (std::system("command -v tshark >/dev/null 2>&1") != 0) {
    GTEST_SKIP() << "needs tshark (Debian: tshark)";
  }
  std::vector<Octets> states;
  for (Octets& pdu : pdus_of_a_run(scene_of(kTwoHandsOnAWall))) {
    if (type_of(pdu) == 1) states.push_back(std::move(pdu));
  }
  const TemporaryFile capture("reckon_states.pcap");
  write_pcap(capture.path(), states);
  const Outcome fields =
      run_program("tshark -n -r " + capture.path().string() +
                  " -T fields -E separator=' ' -e dis.entity_id_site -e dis.entity_id_application "
                  "-e dis.entity_id_entity 2>/dev/null");
  ASSERT_EQ(fields.lines.size(), states.size());
  std::set<std::string> ids(fields.lines.begin(), fields.lines.end());
  EXPECT_EQ(ids, (std::set<std::string>{"1 1 1", "1 2 1", "1 3 1"}));
}

// The script prints "ok N" or a line for each unreadable PDU; it exits with 77 if the package is
// missing.
TEST(ForeignDecoder, OpenDisForJavascriptReadsEveryStandardPdu) {
  if (std::system("command -v node >/dev/null 2>&1") != 0) GTEST_SKIP() << "needs node";
  const TemporaryFile list("reckon_pdus.hex");
  std::size_t count = 0;
  {
    std::ofstream file(list.path());
    for (const Octets& pdu : all_pdus()) {
      if (type_of(pdu) >= 129 || type_of(pdu) == 72) continue;  // unknown to it
      ++count;
      std::array<char, 3> hex{};
      for (const std::byte octet : pdu) {
        std::snprintf(hex.data(), hex.size(), "%02x", std::to_integer<unsigned>(octet));
        file << hex.data();
      }
      file << '\n';
    }
  }
  const Outcome outcome =
      run_program("NODE_PATH=" RECKON_NODE_PATH ":$NODE_PATH node " + reckon::test::source_dir() +
                  "/tests/integration/open_dis.js " + list.path().string());
  if (WEXITSTATUS(outcome.status) == 77) {
    GTEST_SKIP() << "needs the npm package open-dis in node_modules or NODE_PATH";
  }
  ASSERT_EQ(outcome.lines.size(), 1u) << outcome.lines.front();
  EXPECT_EQ(outcome.lines[0], "ok " + std::to_string(count));
}

}  // namespace
}  // namespace reckon::test
