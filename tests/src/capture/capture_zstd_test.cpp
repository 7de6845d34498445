// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Captures in zstd frames, and other files given as captures.
#include <gmock/gmock.h>
#include <zstd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
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

void write_octets(const std::string& path, const std::vector<char>& octets, std::size_t size) {
  std::ofstream(path, std::ios::binary).write(octets.data(), static_cast<std::streamsize>(size));
}

/// Several MiB of compressible datagrams, so that they fill several frames.
std::vector<Kept> many_samples() {
  std::mt19937 random(5);
  std::vector<Kept> out;
  const Kept first = make(random, 1000, false, 0s);
  for (int i = 0; i < 4000; ++i) {
    out.push_back(first);
    out.back().datagram.time = 1'600'000'000s + i * 10ms;
    out.back().bytes[static_cast<std::size_t>(i) % 1000] = static_cast<std::byte>(random());
  }
  return out;
}

TEST(CompressedCapture, KeepsEveryOctetAndNanosecond) {
  const ScratchFolder folder;
  const std::vector<Kept> written = edge_samples();
  write_all(folder.file("a.pcapng.zst"), written);
  const ReadBack read = read_all(folder.file("a.pcapng.zst"));
  EXPECT_EQ(read.datagrams.size(), written.size());
  EXPECT_EQ(read.report.problem, "");
  EXPECT_EQ(read.report.zstd_frames, 1U);
  EXPECT_EQ(read.report.compressed_octets, std::filesystem::file_size(folder.file("a.pcapng.zst")));
  expect_beginning(read.datagrams, written);
}

TEST(CompressedCapture, IsThePlainOneWhenZstdDecompressesIt) {
  if (std::system("command -v zstd >/dev/null") != 0) GTEST_SKIP() << "needs zstd";
  const ScratchFolder folder;
  write_all(folder.file("a.pcapng"), many_samples());
  write_all(folder.file("a.pcapng.zst"), many_samples());
  EXPECT_LT(std::filesystem::file_size(folder.file("a.pcapng.zst")),
            std::filesystem::file_size(folder.file("a.pcapng")) / 5);
  EXPECT_EQ(std::system(
                ("zstd -dc " + folder.file("a.pcapng.zst") + " | cmp - " + folder.file("a.pcapng"))
                    .c_str()),
            0);
  // The other way round: reads a file that zstd wrote as one frame.
  EXPECT_EQ(
      std::system(("zstd -q " + folder.file("a.pcapng") + " -o " + folder.file("b.zst")).c_str()),
      0);
  const ReadBack read = read_all(folder.file("b.zst"));
  EXPECT_EQ(read.datagrams.size(), 4000U);
  EXPECT_EQ(read.report.zstd_frames, 1U);
}

TEST(CompressedCapture, HasFramesThatStandAlone) {
  const ScratchFolder folder;
  const std::vector<Kept> written = many_samples();
  write_all(folder.file("a.pcapng.zst"), written);
  const std::vector<char> octets = octets_of(folder.file("a.pcapng.zst"));
  std::size_t frames = 0;
  std::size_t content = 0;
  std::vector<char> block(std::size_t{2} << 20);
  for (std::size_t at = 0; at < octets.size(); ++frames) {
    const std::size_t size = ZSTD_findFrameCompressedSize(octets.data() + at, octets.size() - at);
    ASSERT_FALSE(ZSTD_isError(size));
    const std::size_t held = ZSTD_decompress(block.data(), block.size(), octets.data() + at, size);
    ASSERT_FALSE(ZSTD_isError(held));
    // Begins with a block: the section header's or an enhanced packet's type.
    EXPECT_EQ(block[0], frames == 0 ? 0x0a : 0x06);
    content += held;
    at += size;
  }
  EXPECT_GE(frames, 4U);
  const ReadBack read = read_all(folder.file("a.pcapng.zst"));
  EXPECT_EQ(read.report.zstd_frames, frames);
  EXPECT_EQ(read.report.compressed_content, content);
}

TEST(CompressedCapture, GivesItsGoodPartWhereverItIsTruncated) {
  const ScratchFolder folder;
  const std::vector<Kept> written = small_samples(12);
  const std::string whole = folder.file("whole.pcapng.zst");
  std::size_t header = 0;
  {
    CaptureWriter writer(options_for(whole));
    header = std::filesystem::file_size(whole);
    for (const Kept& kept : written) {
      writer.write(kept.view());
      writer.flush();
    }
    writer.finish(written.size(), 0);
  }
  const std::vector<char> octets = octets_of(whole);
  std::size_t most = 0;
  for (std::size_t size = header; size < octets.size(); ++size) {
    const std::string path = folder.file("cut.zst");
    write_octets(path, octets, size);
    const ReadBack read = read_all(path);
    expect_beginning(read.datagrams, written);
    EXPECT_GE(read.datagrams.size(), most) << size;
    EXPECT_THAT(read.report.problem, HasSubstr("it ends within a zstd frame: 0 of 1 are intact"));
    most = std::max(most, read.datagrams.size());
  }
  EXPECT_EQ(most, written.size());
}

TEST(CompressedCapture, ErrorCountsTheFramesBeforeATornOne) {
  const ScratchFolder folder;
  write_all(folder.file("whole.pcapng.zst"), many_samples());
  const std::vector<char> octets = octets_of(folder.file("whole.pcapng.zst"));
  const std::uint64_t frames = read_all(folder.file("whole.pcapng.zst")).report.zstd_frames;
  write_octets(folder.file("torn.zst"), octets, octets.size() - 1);
  const ReadBack torn = read_all(folder.file("torn.zst"));
  EXPECT_EQ(torn.datagrams.size(), 4000U);
  EXPECT_THAT(torn.report.problem,
              HasSubstr(std::to_string(frames - 1) + " of " + std::to_string(frames)));
}

TEST(CompressedCapture, IsReadableWhileItGrows) {
  const ScratchFolder folder;
  const std::vector<Kept> written = small_samples(20);
  CaptureWriter writer(options_for(folder.file("a.pcapng.zst")));
  EXPECT_TRUE(read_all(folder.file("a.pcapng.zst")).datagrams.empty());
  for (std::size_t i = 0; i < written.size(); ++i) {
    writer.write(written[i].view());
    writer.flush();
    EXPECT_EQ(read_all(folder.file("a.pcapng.zst")).datagrams.size(), i + 1);
  }
}

TEST(CompressedCapture, IsWholeOnAFullDisk) {
  const ScratchFolder folder;
  const std::vector<Kept> written = small_samples(40);
  write_all(folder.file("whole.pcapng.zst"), written);
  const auto whole = std::filesystem::file_size(folder.file("whole.pcapng.zst"));
  std::uint64_t most = 0;
  for (rlim_t limit = 200; limit < whole - 60; limit += 7) {
    const std::string path = folder.file("full" + std::to_string(limit) + ".zst");
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
    EXPECT_EQ(read.report.problem, "") << limit;
    EXPECT_EQ(read.report.zstd_frames, 1U);
    expect_beginning(read.datagrams, written);
    most = std::max(most, safe);
  }
  EXPECT_GT(most, 20U);
}

TEST(CompressedCapture, RotatesByItsSizeOnTheDisk) {
  const ScratchFolder folder;
  const std::vector<Kept> written = many_samples();
  CaptureWriter writer(
      {.path = folder.file("a.pcapng.zst"), .compress = true, .rotate_octets = 10'000});
  for (const Kept& kept : written) writer.write(kept.view());
  writer.finish(written.size(), 0);
  EXPECT_GT(writer.paths().size(), 3U);
  EXPECT_EQ(writer.paths()[1], folder.file("a_00002.pcapng.zst"));
  std::uint64_t octets = 0;
  for (const std::string& path : writer.paths()) octets += std::filesystem::file_size(path);
  EXPECT_EQ(writer.octets(), octets);
  EXPECT_EQ(writer.datagrams(), written.size());
  const std::vector<Kept> read = read_files(writer.paths());
  EXPECT_EQ(read.size(), written.size());
  expect_beginning(read, written);
}

TEST(CompressedCapture, ErrorNamesTheDamagedFrame) {
  const ScratchFolder folder;
  write_all(folder.file("a.pcapng.zst"), many_samples());
  std::vector<char> octets = octets_of(folder.file("a.pcapng.zst"));
  const std::size_t first = ZSTD_findFrameCompressedSize(octets.data(), octets.size());
  octets[first + 1000] = static_cast<char>(octets[first + 1000] ^ 0x10);
  write_octets(folder.file("b.zst"), octets, octets.size());
  const ReadBack read = read_all(folder.file("b.zst"));
  EXPECT_THAT(read.report.problem, HasSubstr("its zstd frame 2 is damaged"));
  EXPECT_THAT(read.report.problem, HasSubstr("1 before it are intact"));
  EXPECT_GT(read.datagrams.size(), 500U);
}

TEST(CompressedCapture, ReturnsEveryFlushBeforeTheDamage) {
  const ScratchFolder folder;
  const std::vector<Kept> written = small_samples(30);
  std::vector<std::uintmax_t> ends;  // of the file after each datagram
  {
    CaptureWriter writer(options_for(folder.file("a.zst")));
    for (const Kept& kept : written) {
      writer.write(kept.view());
      writer.flush();
      ends.push_back(writer.octets());
    }
  }
  const std::vector<char> octets = octets_of(folder.file("a.zst"));
  std::mt19937 random(23);
  for (int i = 0; i < 500; ++i) {
    std::vector<char> damaged = octets;
    const std::size_t place = ends[0] + random() % (octets.size() - ends[0]);
    for (std::size_t at = place; at < std::min(place + 1 + random() % 8, octets.size()); ++at)
      damaged[at] = static_cast<char>(random());
    write_octets(folder.file("b.zst"), damaged, damaged.size());
    const ReadBack read = read_all(folder.file("b.zst"));
    const auto whole = std::upper_bound(ends.begin(), ends.end(), place) - ends.begin();
    ASSERT_GE(read.datagrams.size(), static_cast<std::size_t>(whole)) << place;
    expect_beginning({read.datagrams.begin(), read.datagrams.begin() + whole}, written);
  }
}

TEST(CompressedCapture, RandomDamageYieldsOnlyWrittenDatagrams) {
  const ScratchFolder folder;
  write_all(folder.file("a.zst"), small_samples(30));
  const std::vector<char> octets = octets_of(folder.file("a.zst"));
  std::mt19937 random(29);
  for (int i = 0; i < 500; ++i) {
    std::vector<char> damaged = octets;
    for (unsigned n = 1 + random() % 4; n > 0; --n)
      damaged[random() % damaged.size()] = static_cast<char>(random());
    write_octets(folder.file("b.zst"), damaged, damaged.size());
    try {
      (void)read_all(folder.file("b.zst"));
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), HasSubstr("give a pcap or pcapng file"));  // its header is damaged
    }
  }
}

TEST(CaptureFile, RefusalOfAnotherFileNamesTheRemedy) {
  const ScratchFolder folder;
  const std::vector<char> zeros(100);
  write_octets(folder.file("empty"), zeros, 0);
  write_octets(folder.file("short"), zeros, 3);
  write_octets(folder.file("zeros"), zeros, 100);
  std::ofstream(folder.file("gzip")) << "\x1f\x8b\x08 and so on";
  std::ofstream(folder.file("zstd")) << "\x28\xb5\x2f\xfd and so on";
  EXPECT_THAT(refusal(folder.file("none")), HasSubstr("none cannot be opened: No such file"));
  EXPECT_THAT(refusal(folder.file("")), HasSubstr("is a folder; name a capture file in it"));
  EXPECT_THAT(refusal(folder.file("empty")), HasSubstr("empty is empty; give"));
  EXPECT_THAT(refusal(folder.file("short")), HasSubstr("give a pcap or pcapng file"));
  EXPECT_THAT(refusal(folder.file("zeros")), HasSubstr("zeros: unknown file format; give"));
  EXPECT_THAT(refusal(folder.file("gzip")), HasSubstr("give a pcap or pcapng file"));
  EXPECT_THAT(refusal(folder.file("zstd")), HasSubstr("its zstd frame 1 is damaged"));
}

TEST(CaptureFile, ReportsDamageInsideCompressedData) {
  const ScratchFolder folder;
  std::vector<char> frame(ZSTD_compressBound(100'000));
  const std::vector<char> text(100'000, 'x');
  const std::size_t size = ZSTD_compress(frame.data(), frame.size(), text.data(), text.size(), 3);
  write_octets(folder.file("text.zst"), frame, size);
  EXPECT_THAT(refusal(folder.file("text.zst")), HasSubstr("decompressed: unknown file format"));
  // An invalid pcapng block in the middle of a valid frame.
  write_all(folder.file("a.pcapng"), many_samples());
  std::vector<char> octets = octets_of(folder.file("a.pcapng"));
  std::fill(octets.begin() + 500'000, octets.begin() + 504'000, '\x7f');
  frame.resize(ZSTD_compressBound(octets.size()));
  write_octets(folder.file("b.zst"), frame,
               ZSTD_compress(frame.data(), frame.size(), octets.data(), octets.size(), 3));
  const ReadBack read = read_all(folder.file("b.zst"));
  EXPECT_GT(read.datagrams.size(), 400U);
  EXPECT_NE(read.report.problem, "");
  EXPECT_EQ(read.report.problem.find("zstd"), std::string::npos) << read.report.problem;
}

TEST(CaptureFile, UncountableTimesReadAsTheLatest) {
  const ScratchFolder folder;
  std::mt19937 random(1);
  write_all(folder.file("a.pcapng"), {make(random, 10, false, nanoseconds::max())});
  const ReadBack read = read_all(folder.file("a.pcapng"));
  ASSERT_EQ(read.datagrams.size(), 1U);
  EXPECT_EQ(std::chrono::floor<std::chrono::seconds>(read.datagrams[0].datagram.time),
            6'000'000'000s);
}

TEST(CaptureFile, RefusesAFrameAboveTheMemoryLimit) {
  const ScratchFolder folder;
  // A frame header of RFC 8878: no content size, a window of 2 GiB.
  std::ofstream(folder.file("huge.zst"), std::ios::binary) << "\x28\xb5\x2f\xfd" << '\0' << "\xa8";
  std::ofstream(folder.file("huge.zst"), std::ios::binary | std::ios::app)
      << std::string(64, '\x01');
  EXPECT_THAT(refusal(folder.file("huge.zst")), HasSubstr("too much memory"));
}

}  // namespace
}  // namespace reckon::peer
