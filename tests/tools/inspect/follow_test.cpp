// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A capture that is read while it grows, cut at every octet.
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "reckon/peer/capture/capture_file.hpp"
#include "reckon/tests/support/capture_builder.hpp"
#include "reckon/tests/support/scratch_folder.hpp"

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;
using test::Octets;

/// Octets of a pcap file with datagrams of `sizes` octets.
std::string pcap_of(std::initializer_list<std::size_t> sizes) {
  test::CaptureBuilder builder;
  for (const std::size_t size : sizes) builder.add(Octets(size, std::byte{1}), nanoseconds(1));
  std::ifstream file(builder.path(), std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The same as pcapng: one section, one Ethernet interface, enhanced packet blocks.
std::string pcapng_of(std::initializer_list<std::size_t> sizes) {
  std::string out;
  const auto put32 = [](std::string& to, std::uint32_t value) {
    for (int shift = 0; shift < 32; shift += 8) to += static_cast<char>(value >> shift & 0xFFU);
  };
  const auto block = [&](std::uint32_t type, const std::string& body) {
    const auto length = static_cast<std::uint32_t>(body.size() + 12);
    put32(out, type);
    put32(out, length);
    out += body;
    put32(out, length);
  };
  std::string section;
  put32(section, 0x1A2B3C4DU);
  put32(section, 1);
  put32(section, 0xFFFFFFFFU);
  put32(section, 0xFFFFFFFFU);
  block(0x0A0D0D0AU, section);
  std::string interface;
  put32(interface, 1);
  put32(interface, 65535);
  block(1, interface);
  constexpr std::size_t kFileHeader = 24;
  constexpr std::size_t kFrameHeader = 16;
  for (const std::size_t size : sizes) {
    const std::string frame = pcap_of({size}).substr(kFileHeader + kFrameHeader);
    std::string packet;
    for (int i = 0; i < 3; ++i) put32(packet, 0);
    put32(packet, static_cast<std::uint32_t>(frame.size()));
    put32(packet, static_cast<std::uint32_t>(frame.size()));
    packet += frame + std::string((4 - frame.size() % 4) % 4, '\0');
    block(6, packet);
  }
  return out;
}

/// Reads the file cut at `cut` octets, then the rest; returns the sizes of the datagrams.
std::vector<std::size_t> sizes_when_cut(const std::string& whole, std::size_t cut,
                                        const std::string& path) {
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(whole.data(), static_cast<std::streamsize>(cut)).flush();
  const auto source = open_capture(path, true);
  EXPECT_TRUE(source->is_live());
  std::vector<std::size_t> sizes;
  SourceDatagram datagram;
  for (int part = 0; part < 2; ++part) {
    SourceEvent event = source->next(datagram, nanoseconds(0));
    for (; event == SourceEvent::datagram; event = source->next(datagram, nanoseconds(0)))
      sizes.push_back(datagram.bytes.size());
    EXPECT_EQ(event, SourceEvent::nothing_yet) << source->report().problem;
    file.write(whole.data() + cut, static_cast<std::streamsize>(whole.size() - cut)).flush();
    cut = whole.size();
  }
  EXPECT_EQ(source->report().frames, sizes.size());
  return sizes;
}

TEST(FollowedCapture, ReturnsEveryDatagramOnceForAnyCut) {
  const test::ScratchFolder folder;
  const std::string path = folder.file("growing");
  const std::vector<std::size_t> expected{40, 41, 60};
  const std::string pcap = pcap_of({40, 41, 60});
  for (std::size_t cut = 24; cut <= pcap.size(); ++cut)
    ASSERT_EQ(sizes_when_cut(pcap, cut, path), expected) << "pcap cut at " << cut;
  const std::string pcapng = pcapng_of({40, 41, 60});
  constexpr std::size_t kBehindInterface = 28 + 20;  // enough to detect a capture
  for (std::size_t cut = kBehindInterface; cut <= pcapng.size(); ++cut)
    ASSERT_EQ(sizes_when_cut(pcapng, cut, path), expected) << "pcapng cut at " << cut;
}

TEST(FollowedCapture, EndsAtABrokenRecord) {
  const test::ScratchFolder folder;
  const std::string path = folder.file("broken");
  std::string pcap = pcap_of({40, 41});
  const std::size_t second = 24 + 16 + 42 + 40;
  for (std::size_t i = 8; i < 12; ++i) pcap[second + i] = '\x7F';  // its length
  std::ofstream(path, std::ios::binary) << pcap;
  const auto source = open_capture(path, true);
  SourceDatagram datagram;
  EXPECT_EQ(source->next(datagram, nanoseconds(0)), SourceEvent::datagram);
  EXPECT_EQ(source->next(datagram, nanoseconds(0)), SourceEvent::end);
  EXPECT_NE(source->report().problem, "");
}

}  // namespace
}  // namespace reckon::peer
