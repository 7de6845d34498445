// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "src/capture_writer.hpp"

#include <gmock/gmock.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "src/capture_file.hpp"
#include "tests/support/scratch_folder.hpp"

namespace reckon::peer {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;
using test::ScratchFolder;
using ::testing::HasSubstr;

/// A datagram that owns its octets.
struct Kept {
  SourceDatagram datagram;
  std::vector<std::byte> bytes;

  [[nodiscard]] SourceDatagram view() const {
    SourceDatagram out = datagram;
    out.bytes = bytes;
    return out;
  }
};

Kept make(std::mt19937& random, std::size_t size, bool ipv6, nanoseconds time) {
  Kept out;
  out.datagram.time = time;
  out.datagram.source = *IpEndpoint::parse(ipv6 ? "[fd00::17]:4001" : "10.0.0.17:4001");
  out.datagram.group = *IpEndpoint::parse(ipv6 ? "[ff15::c0:101]:3000" : "239.192.1.1:3000");
  out.bytes.resize(size);
  for (std::byte& octet : out.bytes) octet = static_cast<std::byte>(random());
  return out;
}

/// Sizes around everything that could be special, IPv4 and IPv6, times that need nanoseconds.
std::vector<Kept> samples() {
  std::mt19937 random(7);
  std::vector<Kept> out;
  nanoseconds time = 1'700'000'000'123'456'789ns;
  for (const std::size_t size : {0, 1, 2, 3, 4, 5, 12, 144, 145, 1400, 9000, 65507}) {
    for (const bool ipv6 : {false, true}) {
      out.push_back(make(random, size, ipv6, time));
      time += nanoseconds(random() % 2'000'000'000);
    }
  }
  return out;
}

std::vector<Kept> small_samples(std::size_t count) {
  std::mt19937 random(11);
  std::vector<Kept> out;
  for (std::size_t i = 0; i < count; ++i)
    out.push_back(make(random, 40 + i, i % 2 == 1, 1'600'000'000s + i * 1s));
  return out;
}

void write_all(const std::string& path, const std::vector<Kept>& datagrams) {
  CaptureWriter writer({.path = path});
  for (const Kept& kept : datagrams) writer.write(kept.view());
  writer.finish(datagrams.size(), 0);
  EXPECT_EQ(writer.datagrams(), datagrams.size());
  EXPECT_EQ(writer.octets(), std::filesystem::file_size(path));
}

struct ReadBack {
  std::vector<Kept> datagrams;
  SourceReport report;
};

ReadBack read_all(const std::string& path) {
  const auto source = open_capture(path);
  ReadBack out;
  SourceDatagram datagram;
  while (source->next(datagram, {}) == SourceEvent::datagram)
    out.datagrams.push_back({datagram, {datagram.bytes.begin(), datagram.bytes.end()}});
  out.report = source->report();
  return out;
}

void expect_equal(const Kept& found, const Kept& wanted) {
  EXPECT_EQ(found.datagram.time, wanted.datagram.time);
  EXPECT_EQ(found.datagram.source, wanted.datagram.source);
  EXPECT_EQ(found.datagram.group, wanted.datagram.group);
  EXPECT_EQ(found.datagram.portion, Portion::whole);
  EXPECT_EQ(found.bytes, wanted.bytes);
}

/// The first `found.size()` of the datagrams written.
void expect_beginning(const std::vector<Kept>& found, const std::vector<Kept>& wanted) {
  ASSERT_LE(found.size(), wanted.size());
  for (std::size_t i = 0; i < found.size(); ++i) expect_equal(found[i], wanted[i]);
}

std::string output_of(const std::string& command) {
  std::FILE* pipe = popen(command.c_str(), "r");
  std::string text;
  for (int letter = std::fgetc(pipe); letter != EOF; letter = std::fgetc(pipe))
    text += static_cast<char>(letter);
  pclose(pipe);
  return text;
}

std::vector<char> octets_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(CaptureWriter, KeepsEveryOctetAndNanosecond) {
  const ScratchFolder folder;
  const std::vector<Kept> written = samples();
  write_all(folder.file("a.pcapng"), written);
  const ReadBack read = read_all(folder.file("a.pcapng"));
  EXPECT_EQ(read.datagrams.size(), written.size());
  EXPECT_TRUE(read.report.problem.empty()) << read.report.problem;
  expect_beginning(read.datagrams, written);
}

TEST(CaptureWriter, IsReadTheSameByTshark) {
  if (std::system("command -v tshark >/dev/null") != 0) GTEST_SKIP() << "needs tshark";
  const ScratchFolder folder;
  const std::vector<Kept> written = samples();
  write_all(folder.file("a.pcapng"), written);
  const std::string rows =
      output_of("tshark -r " + folder.file("a.pcapng") +
                " -o ip.check_checksum:TRUE -o udp.check_checksum:TRUE -T fields -E separator=,"
                " -e frame.time_epoch -e ip.checksum.status -e udp.checksum.status -e udp.length"
                " -e udp.srcport 2>/dev/null");
  std::string wanted;
  for (const Kept& kept : written) {
    const auto count = kept.datagram.time.count();
    std::string nanos = std::to_string(count % 1'000'000'000);
    nanos.insert(0, 9 - nanos.size(), '0');
    wanted += std::to_string(count / 1'000'000'000) + '.' + nanos +
              (kept.datagram.group.is_v6 ? ",,1," : ",1,1,") +
              std::to_string(kept.bytes.size() + 8) + ",4001\n";
  }
  EXPECT_EQ(rows, wanted);
}

TEST(CaptureWriter, KeepsCapturedFramesAsTheyWere) {
  const ScratchFolder folder;
  std::mt19937 random(3);
  Kept kept = make(random, 60, false, 5s + 1ns);
  std::vector<std::byte> packet;
  make_ip_packet(kept.view(), packet);
  std::vector<std::byte> frame(14, std::byte{2});
  frame[12] = std::byte{8};
  frame[13] = std::byte{0};
  frame.insert(frame.end(), packet.begin(), packet.end());

  constexpr std::uint16_t kEthernet = 1;
  {
    CaptureWriter writer({.path = folder.file("a.pcapng"), .link_type = kEthernet});
    SourceDatagram datagram = kept.view();
    datagram.captured = std::span(frame).first(frame.size() - 10);
    datagram.captured_on_wire = frame.size();
    writer.write(datagram);
  }
  const auto source = open_capture(folder.file("a.pcapng"));
  SourceDatagram datagram;
  ASSERT_EQ(source->next(datagram, {}), SourceEvent::datagram);
  EXPECT_EQ(source->link_type(), kEthernet);
  EXPECT_EQ(datagram.portion, Portion::cut);
  EXPECT_EQ(datagram.captured_on_wire, frame.size());
  EXPECT_TRUE(std::equal(datagram.captured.begin(), datagram.captured.end(), frame.begin()));
  EXPECT_EQ(datagram.captured.size(), frame.size() - 10);
}

TEST(CaptureWriter, LeavesAFileThatIsReadableWhereverItIsTruncated) {
  const ScratchFolder folder;
  const std::vector<Kept> written = small_samples(6);
  write_all(folder.file("whole.pcapng"), written);
  const std::vector<char> octets = octets_of(folder.file("whole.pcapng"));
  constexpr std::size_t kHeader = 60;  // section header and interface, written in one piece
  std::size_t most = 0;
  for (std::size_t size = kHeader; size <= octets.size(); ++size) {
    const std::string path = folder.file("cut.pcapng");
    std::ofstream(path, std::ios::binary).write(octets.data(), static_cast<std::streamsize>(size));
    const ReadBack read = read_all(path);
    expect_beginning(read.datagrams, written);
    EXPECT_GE(read.datagrams.size(), most) << size;
    most = std::max(most, read.datagrams.size());
  }
  EXPECT_EQ(most, written.size());
}

TEST(CaptureWriter, IsReadableWhileItGrows) {
  const ScratchFolder folder;
  const std::vector<Kept> written = small_samples(20);
  CaptureWriter writer({.path = folder.file("a.pcapng")});
  EXPECT_TRUE(read_all(folder.file("a.pcapng")).datagrams.empty());
  for (std::size_t i = 0; i < written.size(); ++i) {
    writer.write(written[i].view());
    writer.flush();
    const ReadBack read = read_all(folder.file("a.pcapng"));
    EXPECT_EQ(read.datagrams.size(), i + 1);
    EXPECT_TRUE(read.report.problem.empty());
  }
}

/// The kernel writes no file beyond `octets` while this lives: it takes what fits, then refuses, as
/// a full disk does.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t octets) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{octets, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  void (*handler_)(int);
  rlimit before_{};
};

/// Writes until the disk is full; what the error says.
std::string fill(const std::string& path, const std::vector<Kept>& datagrams, std::uint64_t& safe) {
  CaptureWriter writer({.path = path});
  try {
    for (const Kept& kept : datagrams) writer.write(kept.view());
    writer.flush();
  } catch (const CaptureWriteError& error) {
    safe = writer.datagrams();
    return error.what();
  }
  return {};
}

TEST(CaptureWriter, EndsWithAWholeBlockWhereTheDiskIsFull) {
  const ScratchFolder folder;
  const std::vector<Kept> written = small_samples(12);
  write_all(folder.file("whole.pcapng"), written);
  const auto whole = std::filesystem::file_size(folder.file("whole.pcapng"));
  for (rlim_t limit = 60; limit < whole - 60; limit += 7) {
    const std::string path = folder.file("full" + std::to_string(limit));
    std::uint64_t safe = 0;
    std::string text;
    {
      const FileSizeLimit full(limit);
      text = fill(path, written, safe);
    }
    EXPECT_THAT(text, HasSubstr(path));
    EXPECT_THAT(text, HasSubstr(std::to_string(safe) + " datagrams before that are safe"));
    const ReadBack read = read_all(path);
    EXPECT_EQ(read.datagrams.size(), safe) << limit;
    EXPECT_TRUE(read.report.problem.empty()) << read.report.problem;
    expect_beginning(read.datagrams, written);
  }
}

TEST(CaptureWriter, TellsThatAFullDeviceTakesNothing) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "needs /dev/full";
  try {
    CaptureWriter writer({.path = "/dev/full", .overwrite = true});
    ADD_FAILURE() << "no error";
  } catch (const CaptureWriteError& error) {
    EXPECT_THAT(error.what(), HasSubstr("/dev/full: No space left on device; 0 datagrams"));
  }
}

TEST(CaptureWriter, OverwritesOnlyWhereItMay) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.pcapng");
  write_all(path, small_samples(3));
  EXPECT_THROW(CaptureWriter({.path = path}), CaptureWriteError);
  EXPECT_EQ(read_all(path).datagrams.size(), 3U);
  { CaptureWriter writer({.path = path, .overwrite = true}); }
  EXPECT_TRUE(read_all(path).datagrams.empty());
  EXPECT_THROW(CaptureWriter({.path = folder.file("none/a.pcapng")}), CaptureWriteError);
}

/// What all files of a rotation hold, one after another.
std::vector<Kept> read_files(const std::vector<std::string>& paths) {
  std::vector<Kept> out;
  for (const std::string& path : paths) {
    const ReadBack read = read_all(path);
    EXPECT_FALSE(read.datagrams.empty()) << path;
    out.insert(out.end(), read.datagrams.begin(), read.datagrams.end());
  }
  return out;
}

TEST(CaptureWriter, RotatesBySizeWithoutLoss) {
  const ScratchFolder folder;
  const std::vector<Kept> written = small_samples(30);
  CaptureWriter writer({.path = folder.file("a.pcapng"), .rotate_octets = 1000});
  for (const Kept& kept : written) writer.write(kept.view());
  writer.finish(30, 0);
  EXPECT_GT(writer.paths().size(), 3U);
  EXPECT_EQ(writer.paths()[0], folder.file("a_00001.pcapng"));
  EXPECT_EQ(writer.paths()[1], folder.file("a_00002.pcapng"));
  const std::vector<Kept> read = read_files(writer.paths());
  EXPECT_EQ(read.size(), written.size());
  expect_beginning(read, written);
}

TEST(CaptureWriter, RotatesByTheDatagramsTime) {
  const ScratchFolder folder;
  const std::vector<Kept> written = small_samples(30);  // one a second
  CaptureWriter writer({.path = folder.file("a.pcapng"), .rotate_after = 10s});
  for (const Kept& kept : written) writer.write(kept.view());
  writer.finish(30, 0);
  EXPECT_EQ(writer.paths().size(), 3U);
  const std::vector<Kept> read = read_files(writer.paths());
  EXPECT_EQ(read.size(), written.size());
  expect_beginning(read, written);
}

}  // namespace
}  // namespace reckon::peer
