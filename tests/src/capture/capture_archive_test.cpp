// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Captures compressed by other programs: gzip, bzip2, xz, lz4.
#include <archive.h>
#include <archive_entry.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include "reckon/peer/capture/archive_decompressor.hpp"
#include "reckon/peer/capture/archive_library.hpp"
#include "reckon/tests/src/support/capture_samples.hpp"
#include "reckon/tests/support/scratch_folder.hpp"

namespace reckon::peer {
namespace {

using namespace samples;
using test::ScratchFolder;
using ::testing::AnyOf;
using ::testing::HasSubstr;

const std::vector<std::string> kMethods{"gzip", "bzip2", "xz", "lz4"};

/// Compresses the output of `write(archive)` into a file.
template <typename Write>
void compress_to(const std::string& path, const std::string& method, Write&& write) {
  archive* out = archive_write_new();
  ASSERT_EQ(archive_write_add_filter_by_name(out, method.c_str()), ARCHIVE_OK);
  // lz4 uses blocks of 64 KiB; the other methods have no such option.
  (void)archive_write_set_filter_option(out, "lz4", "block-size", "4");
  ASSERT_EQ(archive_write_set_format_raw(out), ARCHIVE_OK);
  ASSERT_EQ(archive_write_open_filename(out, path.c_str()), ARCHIVE_OK);
  archive_entry* entry = archive_entry_new();
  archive_entry_set_filetype(entry, AE_IFREG);
  ASSERT_EQ(archive_write_header(out, entry), ARCHIVE_OK);
  write(out);
  archive_entry_free(entry);
  ASSERT_EQ(archive_write_close(out), ARCHIVE_OK);
  archive_write_free(out);
}

void compress(const std::string& from, const std::string& to, const std::string& method) {
  const std::vector<char> octets = octets_of(from);
  compress_to(to, method,
              [&](archive* out) { archive_write_data(out, octets.data(), octets.size()); });
}

/// Random datagrams of 1,400 octets, so that they hardly compress.
std::vector<Kept> drawn_samples(int count) {
  std::mt19937 random(41);
  std::vector<Kept> out;
  for (int i = 0; i < count; ++i) out.push_back(make(random, 1400, false, 1'600'000'000s + i * 1s));
  return out;
}

TEST(ArchivedCapture, IsReadAsThePlainOne) {
  const ScratchFolder folder;
  const std::vector<Kept> written = drawn_samples(200);
  write_all(folder.file("a.pcapng"), written);
  const auto plain = std::filesystem::file_size(folder.file("a.pcapng"));
  for (const std::string& method : kMethods) {
    compress(folder.file("a.pcapng"), folder.file(method), method);
    const ReadBack read = read_all(folder.file(method));
    EXPECT_EQ(read.datagrams.size(), written.size()) << method;
    expect_beginning(read.datagrams, written);
    EXPECT_EQ(read.report.problem, "");
    EXPECT_EQ(read.report.compression, method);
    EXPECT_EQ(read.report.compressed_octets, std::filesystem::file_size(folder.file(method)));
    EXPECT_EQ(read.report.compressed_content, plain);
    EXPECT_EQ(read.report.zstd_frames, 0U);
  }
}

TEST(ArchivedCapture, ErrorsOfDamagedFilesNameTheMethod) {
  const ScratchFolder folder;
  const std::vector<Kept> written = drawn_samples(1000);
  write_all(folder.file("a.pcapng"), written);
  for (const std::string& method : kMethods) {
    compress(folder.file("a.pcapng"), folder.file(method), method);
    std::vector<char> octets = octets_of(folder.file(method));
    std::ofstream(folder.file("cut"), std::ios::binary)
        .write(octets.data(), static_cast<std::streamsize>(octets.size() - 100));
    const ReadBack cut = read_all(folder.file("cut"));
    expect_beginning(cut.datagrams, written);
    EXPECT_GT(cut.datagrams.size(), 500U) << method;
    EXPECT_LT(cut.datagrams.size(), written.size()) << method;
    EXPECT_THAT(cut.report.problem, HasSubstr("(its " + method + " data is damaged: "));
  }
}

TEST(ArchivedCapture, IsRefusedWhereItHoldsNoCapture) {
  const ScratchFolder folder;
  for (const std::string& method : kMethods) {
    compress_to(folder.file("text"), method, [](archive* out) {
      archive_write_data(out, "this is no capture at all, only some text", 41);
    });
    EXPECT_THAT(refusal(folder.file("text")),
                HasSubstr("text, decompressed: unknown file format; give a pcap or pcapng file"));
    compress(folder.file("text"), folder.file("twice"), method);
    EXPECT_THAT(refusal(folder.file("twice")), HasSubstr("it is compressed more than once by " +
                                                         method + "; decompress it first"));
    std::vector<char> octets = octets_of(folder.file("text"));
    std::ofstream(folder.file("head"), std::ios::binary).write(octets.data(), 7);
    EXPECT_THAT(refusal(folder.file("head")), HasSubstr("give a pcap or pcapng file"));
  }
}

// The first library does not exist, and the second has no such functions.
TEST(ArchivedCapture, MissingLibraryIsNamedWithItsPackage) {
  for (const char* name : {"libarchive.so.none", "libc.so.6"}) {
    const ArchiveLibrary library = load_archive_library(name);
    ArchiveDecompressor gzip(
        "gzip", [] { return std::span<const std::byte>(); }, library);
    std::array<std::byte, 16> out{};
    EXPECT_EQ(gzip.decompress(out), 0U);
    EXPECT_THAT(gzip.error(), HasSubstr(std::string("is compressed by gzip, and ") + name));
    EXPECT_THAT(gzip.error(), HasSubstr("; install the package libarchive13, or decompress"));
  }
}

/// Runs in a child process with 1 GiB of address space.
template <typename Body>
int status_in_little_memory(Body&& body) {
  const pid_t child = fork();
  if (child == 0) {
    const rlimit limit{rlim_t{1} << 30, rlim_t{1} << 30};
    setrlimit(RLIMIT_AS, &limit);
    _exit(body());
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(ArchivedCapture, StreamsAFileLargerThanMemory) {
  const ScratchFolder folder;
  write_all(folder.file("a.pcapng"), small_samples(3));
  std::vector<char> begin = octets_of(folder.file("a.pcapng"));
  // 1.25 GiB of blocks of an unknown type: zeros except for the block headers.
  std::vector<char> block(std::size_t{1} << 24);
  const std::uint32_t type = 0xbad;
  const auto length = static_cast<std::uint32_t>(block.size());
  std::memcpy(block.data(), &type, 4);
  std::memcpy(block.data() + 4, &length, 4);
  std::memcpy(block.data() + block.size() - 4, &length, 4);
  compress_to(folder.file("bomb"), "lz4", [&](archive* out) {
    archive_write_data(out, begin.data(), begin.size());
    for (int i = 0; i < 80; ++i) archive_write_data(out, block.data(), block.size());
    archive_write_data(out, begin.data(), begin.size());
  });
  EXPECT_EQ(status_in_little_memory([&] {
              const ReadBack read = read_all(folder.file("bomb"));
              return read.datagrams.size() == 6 && read.report.problem.empty() ? 0 : 1;
            }),
            0);
}

}  // namespace
}  // namespace reckon::peer
