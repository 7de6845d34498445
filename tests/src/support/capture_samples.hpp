// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Datagrams for tests of captures: make, write, read back; and a full disk.
#pragma once

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "reckon/peer/capture/capture_file.hpp"
#include "reckon/peer/capture/capture_writer.hpp"

namespace reckon::peer::samples {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

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

inline Kept make(std::mt19937& random, std::size_t size, bool ipv6, nanoseconds time) {
  Kept out;
  out.datagram.time = time;
  out.datagram.source = *IpEndpoint::parse(ipv6 ? "[fd00::17]:4001" : "10.0.0.17:4001");
  out.datagram.group = *IpEndpoint::parse(ipv6 ? "[ff15::c0:101]:3000" : "239.192.1.1:3000");
  out.bytes.resize(size);
  for (std::byte& octet : out.bytes) octet = static_cast<std::byte>(random());
  return out;
}

/// Datagrams with all special sizes, IPv4 and IPv6, and times that need nanoseconds.
inline std::vector<Kept> edge_samples() {
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

inline std::vector<Kept> small_samples(std::size_t count) {
  std::mt19937 random(11);
  std::vector<Kept> out;
  for (std::size_t i = 0; i < count; ++i)
    out.push_back(make(random, 40 + i, i % 2 == 1, 1'600'000'000s + i * 1s));
  return out;
}

/// A name that ends in .zst is compressed.
inline CaptureWriterOptions options_for(const std::string& path) {
  return {.path = path, .compress = path.ends_with(".zst")};
}

inline void write_all(const std::string& path, const std::vector<Kept>& datagrams) {
  CaptureWriter writer(options_for(path));
  for (const Kept& kept : datagrams) writer.write(kept.view());
  writer.finish(datagrams.size(), 0);
  EXPECT_EQ(writer.datagrams(), datagrams.size());
  EXPECT_EQ(writer.octets(), std::filesystem::file_size(path));
}

struct ReadBack {
  std::vector<Kept> datagrams;
  SourceReport report;
};

inline ReadBack read_all(const std::string& path) {
  const auto source = open_capture(path);
  ReadBack out;
  SourceDatagram datagram;
  while (source->next(datagram, {}) == SourceEvent::datagram)
    out.datagrams.push_back({datagram, {datagram.bytes.begin(), datagram.bytes.end()}});
  out.report = source->report();
  return out;
}

/// The error text of opening `path`.
inline std::string refusal(const std::string& path) {
  try {
    (void)open_capture(path);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

inline void expect_equal(const Kept& found, const Kept& wanted) {
  EXPECT_EQ(found.datagram.time, wanted.datagram.time);
  EXPECT_EQ(found.datagram.source, wanted.datagram.source);
  EXPECT_EQ(found.datagram.group, wanted.datagram.group);
  EXPECT_EQ(found.datagram.portion, Portion::whole);
  EXPECT_EQ(found.bytes, wanted.bytes);
}

/// Expects `found` to equal the first datagrams of `wanted`.
inline void expect_beginning(const std::vector<Kept>& found, const std::vector<Kept>& wanted) {
  ASSERT_LE(found.size(), wanted.size());
  for (std::size_t i = 0; i < found.size(); ++i) expect_equal(found[i], wanted[i]);
}

inline std::string output_of(const std::string& command) {
  std::FILE* pipe = popen(command.c_str(), "r");
  std::string text;
  for (int letter = std::fgetc(pipe); letter != EOF; letter = std::fgetc(pipe))
    text += static_cast<char>(letter);
  pclose(pipe);
  return text;
}

inline std::vector<char> octets_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Limits files of this process to `octets` during its lifetime. The kernel writes what fits, then
/// refuses, as a full disk does.
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

/// Writes until the disk is full; returns the error text. A compressed writer is flushed after each
/// datagram, as with a slow source.
inline std::string fill(const std::string& path, const std::vector<Kept>& datagrams,
                        std::uint64_t& safe) {
  CaptureWriter writer(options_for(path));
  try {
    for (const Kept& kept : datagrams) {
      writer.write(kept.view());
      if (path.ends_with(".zst")) writer.flush();
    }
    writer.close();
  } catch (const CaptureWriteError& error) {
    safe = writer.datagrams();
    return error.what();
  }
  return {};
}

/// The datagrams of all files of a rotation, in order.
inline std::vector<Kept> read_files(const std::vector<std::string>& paths) {
  std::vector<Kept> out;
  for (const std::string& path : paths) {
    const ReadBack read = read_all(path);
    EXPECT_FALSE(read.datagrams.empty()) << path;
    EXPECT_EQ(read.report.problem, "");
    out.insert(out.end(), read.datagrams.begin(), read.datagrams.end());
  }
  return out;
}

}  // namespace reckon::peer::samples
