// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/capture/capture_writer.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "reckon/tests/src/support/capture_samples.hpp"
#include "reckon/tests/support/scratch_folder.hpp"

namespace reckon::peer {
namespace {

using namespace std::chrono_literals;
using namespace samples;
using test::ScratchFolder;
using ::testing::HasSubstr;

TEST(CaptureWriter, KeepsEveryOctetAndNanosecond) {
  const ScratchFolder folder;
  const std::vector<Kept> written = edge_samples();
  write_all(folder.file("a.pcapng"), written);
  const ReadBack read = read_all(folder.file("a.pcapng"));
  EXPECT_EQ(read.datagrams.size(), written.size());
  EXPECT_TRUE(read.report.problem.empty()) << read.report.problem;
  expect_beginning(read.datagrams, written);
}

TEST(CaptureWriter, IsReadTheSameByTshark) {
  if (std::system("command -v tshark >/dev/null") != 0) GTEST_SKIP() << "needs tshark";
  const ScratchFolder folder;
  const std::vector<Kept> written = edge_samples();
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
    datagram.link_type = kEthernet;
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

TEST(CaptureWriter, FileStaysReadableAfterAnyTruncation) {
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

TEST(CaptureWriter, EndsWithWholeBlocksOnAFullDisk) {
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

TEST(CaptureWriter, ReportsAFullDevice) {
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

/// Octets of all files in a folder.
std::uintmax_t octets_in(const ScratchFolder& folder) {
  std::uintmax_t sum = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.file("")))
    sum += entry.file_size();
  return sum;
}

TEST(CaptureWriter, KeepsAllFilesTogetherWithinTheirBound) {
  for (const bool compress : {false, true}) {
    const ScratchFolder folder;
    const std::vector<Kept> written = small_samples(200);
    CaptureWriter writer({.path = folder.file("a.pcapng"),
                          .compress = compress,
                          .rotate_octets = 1000,
                          .rotate_total = 4000});
    for (const Kept& kept : written) {
      writer.write(kept.view());
      writer.flush();
      EXPECT_LE(octets_in(folder), 4000U + 200U);  // the last file may exceed its by a datagram
      EXPECT_EQ(octets_in(folder), writer.octets());
    }
    writer.close();
    EXPECT_GT(octets_in(folder), 2000U);
    const std::vector<Kept> read = read_files(writer.paths());
    EXPECT_GT(writer.removed().files, 0U);
    EXPECT_EQ(writer.datagrams(), read.size());
    EXPECT_EQ(writer.removed().datagrams + read.size(), written.size());
    const auto begin = written.end() - static_cast<std::ptrdiff_t>(read.size());
    expect_beginning(read, std::vector<Kept>(begin, written.end()));
  }
}

TEST(CaptureWriter, BoundsFilesThatEndByTime) {
  const ScratchFolder folder;
  CaptureWriter writer(
      {.path = folder.file("a.pcapng"), .rotate_after = 1h, .rotate_total = 10'000});
  for (const Kept& kept : small_samples(200)) writer.write(kept.view());  // 200 s
  writer.close();
  EXPECT_LE(octets_in(folder), 10'200U);
  EXPECT_GT(octets_in(folder), 8'000U);
}

TEST(CaptureWriter, RemovesNoFileOfAnother) {
  const ScratchFolder folder;
  std::ofstream(folder.file("a_00000.pcapng")) << "of an earlier run";
  CaptureWriter writer(
      {.path = folder.file("a.pcapng"), .rotate_octets = 1000, .rotate_total = 3000});
  const std::vector<Kept> written = small_samples(100);
  for (const Kept& kept : written) {
    writer.write(kept.view());
    if (writer.paths().size() != 2 || std::filesystem::exists(folder.file("moved"))) continue;
    std::filesystem::rename(folder.file("a_00001.pcapng"), folder.file("moved"));
    std::ofstream(folder.file("a_00001.pcapng")) << "put in its place";
  }
  writer.close();
  EXPECT_GT(writer.removed().files, 0U);
  for (const char* name : {"a_00000.pcapng", "a_00001.pcapng", "moved"})
    EXPECT_TRUE(std::filesystem::exists(folder.file(name))) << name;
  EXPECT_FALSE(std::filesystem::exists(folder.file("a_00002.pcapng")));
}

}  // namespace
}  // namespace reckon::peer
