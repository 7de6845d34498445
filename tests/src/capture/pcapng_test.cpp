// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// pcapng files of other programs: several interfaces, sections, octet orders, and damage.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "reckon/peer/capture/capture_file.hpp"
#include "reckon/tests/src/support/capture_samples.hpp"
#include "reckon/tests/src/support/made_fragments.hpp"
#include "reckon/tests/src/support/pcapng_file.hpp"
#include "reckon/tests/support/scratch_folder.hpp"

namespace reckon::peer {
namespace {

using namespace frames;
using namespace samples;
using blocks::kCooked;
using blocks::kCooked2;
using blocks::kEthernet;
using blocks::kUsb;
using blocks::PcapngFile;
using std::chrono::nanoseconds;
using test::ScratchFolder;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<std::size_t> sizes_of(const ReadBack& read) {
  std::vector<std::size_t> sizes;
  for (const Kept& kept : read.datagrams) sizes.push_back(kept.bytes.size());
  return sizes;
}

Bytes cooked(const Bytes& ip) { return Bytes(14, 0) + u16(0x0800) + ip; }

TEST(Pcapng, MixesInterfaceLinkTypesAndSnapLengths) {
  const ScratchFolder folder;
  for (const bool is_swapped : {false, true}) {
    PcapngFile file(is_swapped);
    file.interface(kEthernet, 65535);
    file.interface(kLinkTypeRawIp, 262144);
    file.packet(0, 1, ethernet(ipv4(udp(10))));
    file.packet(1, 2, ipv4(udp(11)));
    file.interface(kCooked, 96);
    file.interface(kCooked2, 0);
    file.packet(2, 3, cooked(ipv4(udp(12))));
    file.packet(3, 4, u16(0x0800) + Bytes(18, 0) + ipv4(udp(13)));
    file.packet(0, 5, ethernet(ipv4(udp(14))));
    const ReadBack read = read_all(file.write(folder.file("mixed.pcapng")));
    EXPECT_THAT(sizes_of(read), ElementsAre(10, 11, 12, 13, 14));
    EXPECT_EQ(read.report.problem, "");
    EXPECT_EQ(read.datagrams[3].datagram.link_type, kCooked2);
    EXPECT_EQ(read.datagrams[4].datagram.link_type, kEthernet);
  }
}

TEST(Pcapng, HasAClockForEachInterface) {
  const ScratchFolder folder;
  PcapngFile file;
  const auto clock = [&](std::uint8_t resolution, std::int64_t offset = 0) {
    file.interface(kEthernet, 65535,
                   file.option(9, {resolution}) + file.option(14, file.number(offset)));
  };
  file.interface(kEthernet, 65535);
  clock(9);
  clock(0x80 + 10);
  clock(0, 1'000'000'000);
  clock(19);
  clock(0x80 + 63);
  clock(12, std::numeric_limits<std::int64_t>::min());
  const std::vector<std::uint64_t> stamps = {1'600'000'000'000'001,
                                             1'600'000'000'000'000'001,
                                             1024 * 7 + 512,
                                             600'000'000,
                                             15'000'000'000'000'000'000U,
                                             (std::uint64_t{1} << 62),
                                             7};
  for (std::uint32_t i = 0; i < stamps.size(); ++i)
    file.packet(i, stamps[i], ethernet(ipv4(udp(4))));
  const ReadBack read = read_all(file.write(folder.file("clocks.pcapng")));
  std::vector<nanoseconds> times;
  for (const Kept& kept : read.datagrams) times.push_back(kept.datagram.time);
  EXPECT_THAT(times, ElementsAre(1'600'000'000'000'001'000ns, 1'600'000'000'000'000'001ns, 7500ms,
                                 1'600'000'000s, 1500ms, 500ms,
                                 -std::chrono::seconds(std::int64_t{1} << 31)));
}

TEST(Pcapng, ReadsSectionsWithOtherInterfacesAndOctetOrder) {
  const ScratchFolder folder;
  PcapngFile file;
  file.interface(kEthernet, 65535);
  file.packet(0, 1, ethernet(ipv4(udp(10))));
  file.swap_order();
  file.section();
  file.interface(kLinkTypeRawIp, 65535);
  file.packet(0, 2, ipv4(udp(11)));
  const ReadBack read = read_all(file.write(folder.file("sections.pcapng")));
  EXPECT_THAT(sizes_of(read), ElementsAre(10, 11));
  EXPECT_EQ(read.report.problem, "");
}

TEST(Pcapng, HasSimpleAndObsoletePacketsAndUnknownBlocks) {
  const ScratchFolder folder;
  PcapngFile file;
  file.interface(kEthernet, 60);
  file.block(0xbad, Bytes(1000, 7));
  const Bytes frame = ethernet(ipv4(udp(100)));
  const Bytes kept(frame.begin(), frame.begin() + 60);
  const auto size = static_cast<std::uint32_t>(frame.size());
  file.block(3, file.number(size) + kept);
  file.block(2, file.number<std::uint32_t>(0) + file.number<std::uint32_t>(0) +
                    file.number<std::uint32_t>(9) + file.number(size) + file.number(size) + frame);
  const ReadBack read = read_all(file.write(folder.file("blocks.pcapng")));
  ASSERT_EQ(read.datagrams.size(), 2U) << read.report.problem;
  EXPECT_EQ(read.datagrams[0].datagram.portion, Portion::cut);
  EXPECT_EQ(read.datagrams[0].bytes.size(), 18U);
  EXPECT_EQ(read.datagrams[1].bytes.size(), 100U);
  EXPECT_EQ(read.datagrams[1].datagram.time, 9us);
}

TEST(Pcapng, GivesASimplePacketTheTimeBefore) {
  const ScratchFolder folder;
  PcapngFile file;
  file.interface(kEthernet, 65535);
  const Bytes frame = ethernet(ipv4(udp(10)));
  file.packet(0, 7, frame);
  file.block(3, file.number(static_cast<std::uint32_t>(frame.size())) + frame);
  const ReadBack read = read_all(file.write(folder.file("simple.pcapng")));
  ASSERT_EQ(read.datagrams.size(), 2U) << read.report.problem;
  EXPECT_EQ(read.datagrams[1].datagram.time, read.datagrams[0].datagram.time);
}

TEST(Pcapng, CountsFramesOfUnreadLinkTypes) {
  const ScratchFolder folder;
  PcapngFile file;
  file.interface(kUsb, 65535);
  file.interface(kEthernet, 65535);
  file.packet(0, 1, Bytes(64, 1));
  file.packet(1, 2, ethernet(ipv4(udp(10))));
  file.packet(0, 3, Bytes(64, 1));
  const ReadBack read = read_all(file.write(folder.file("usb.pcapng")));
  EXPECT_THAT(sizes_of(read), ElementsAre(10));
  EXPECT_EQ(read.report.skipped, 2U);
  EXPECT_THAT(read.report.problem,
              HasSubstr("usb.pcapng: 2 of its frames are skipped: link type 220 ("));
}

TEST(Pcapng, ReportsDamageAndKeepsTheFramesBefore) {
  struct Case {
    const char* problem;
    void (*plant)(PcapngFile&);
  };
  const std::vector<Case> cases = {
      {"a packet of interface 1, but 1 are described",
       [](PcapngFile& f) { f.packet(1, 2, ethernet(ipv4(udp(10)))); }},
      {"a block of type 6 has a length of 13",
       [](PcapngFile& f) { f.octets() = f.octets() + f.number(6U) + f.number(13U) + Bytes(5, 0); }},
      {"a block of type 9 has a length of 4294967292",
       [](PcapngFile& f) { f.octets() = f.octets() + f.number(9U) + f.number(0xfffffffcU); }},
      {"a block of type 9 has a length of 16 and, at its end, of 20",
       [](PcapngFile& f) {
         f.octets() = f.octets() + f.number(9U) + f.number(16U) + Bytes(4, 0) + f.number(20U);
       }},
      {"instead of the byte-order magic", [](PcapngFile& f) { f.block(0x0a0d0d0a, Bytes(16, 3)); }},
      {"pcapng version 2 is not supported",
       [](PcapngFile& f) {
         f.block(0x0a0d0d0a, f.number(0x1a2b3c4dU) + f.number<std::uint16_t>(2) + Bytes(10, 0));
       }},
      {"an interface with a time resolution of 0x14",
       [](PcapngFile& f) { f.interface(kEthernet, 0, f.option(9, {20})); }},
      {"option 9 of an interface is longer than its block",
       [](PcapngFile& f) {
         f.interface(kEthernet, 0, Bytes{9, 0, 200, 0});
       }},
      {"an interface description of less", [](PcapngFile& f) { f.block(1, Bytes(4, 0)); }},
      {"a packet block of 28 octets", [](PcapngFile& f) { f.block(6, Bytes(16, 0)); }},
      {"a packet of 100 octets in a block of 32",
       [](PcapngFile& f) { f.block(6, Bytes(12, 0) + f.number(100U) + f.number(100U)); }},
      {"truncated: only 6 of 12 octets",
       [](PcapngFile& f) { f.octets() = f.octets() + Bytes(6, 0); }}};
  const ScratchFolder folder;
  for (const Case& row : cases) {
    PcapngFile file;
    file.interface(kEthernet, 65535);
    file.packet(0, 1, ethernet(ipv4(udp(10))));
    row.plant(file);
    const ReadBack read = read_all(file.write(folder.file("damaged.pcapng")));
    EXPECT_THAT(sizes_of(read), ElementsAre(10));
    EXPECT_THAT(read.report.problem, HasSubstr("beyond frame 1 ("));
    EXPECT_THAT(read.report.problem, HasSubstr(row.problem));
  }
}

TEST(Pcapng, IsRefusedWithoutAnInterface) {
  const ScratchFolder folder;
  PcapngFile none;
  EXPECT_THAT([&] { (void)open_capture(none.write(folder.file("a"))); },
              ::testing::ThrowsMessage<std::runtime_error>(
                  HasSubstr("it ends before its first interface is described; give a pcap")));
  none.packet(0, 0, {});
  EXPECT_THAT([&] { (void)open_capture(none.write(folder.file("a"))); },
              ::testing::ThrowsMessage<std::runtime_error>(
                  HasSubstr("a packet before the first interface")));
}

TEST(Pcapng, ReadsFramesBeforeEveryTruncation) {
  const ScratchFolder folder;
  PcapngFile file;
  file.interface(kEthernet, 65535);
  file.packet(0, 1, ethernet(ipv4(udp(10))));
  const std::size_t first = file.octets().size();
  file.interface(kLinkTypeRawIp, 0);
  file.packet(1, 2, ipv4(udp(11)));
  const Bytes whole = file.octets();
  for (std::size_t size = first; size < whole.size(); ++size) {
    file.octets() = {whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)};
    const ReadBack read = read_all(file.write(folder.file("cut.pcapng")));
    ASSERT_THAT(sizes_of(read), ElementsAre(10)) << size;
  }
}

TEST(Pcapng, IsReadWhileItGrowsByOctets) {
  const ScratchFolder folder;
  PcapngFile file;
  file.interface(kEthernet, 65535);
  const std::size_t first = file.octets().size();
  file.packet(0, 1, ethernet(ipv4(udp(10))));
  file.interface(kLinkTypeRawIp, 0);
  file.packet(1, 2, ipv4(udp(11)));
  const Bytes whole = file.octets();
  file.octets().resize(first);
  const auto source = open_capture(file.write(folder.file("grows.pcapng")), true);
  std::ofstream out(folder.file("grows.pcapng"), std::ios::binary | std::ios::app);
  std::vector<std::size_t> sizes;
  SourceDatagram datagram;
  for (std::size_t at = first; at < whole.size(); ++at) {
    EXPECT_EQ(source->next(datagram, 0ns), SourceEvent::nothing_yet);
    out.put(static_cast<char>(whole[at])).flush();
    if (source->next(datagram, 0ns) == SourceEvent::datagram)
      sizes.push_back(datagram.bytes.size());
  }
  EXPECT_THAT(sizes, ElementsAre(10, 11));
}

TEST(CaptureWriter, DescribesAnInterfaceForEachLinkType) {
  const ScratchFolder folder;
  const std::vector<Bytes> frames = {ethernet(ipv4(udp(10))), ipv4(udp(11)), cooked(ipv4(udp(12))),
                                     ethernet(ipv4(udp(13)))};
  const std::vector<std::uint16_t> types = {kEthernet, kLinkTypeRawIp, kCooked, kEthernet};
  {
    CaptureWriter writer({.path = folder.file("a.pcapng"), .link_type = kEthernet});
    for (std::size_t i = 0; i < frames.size(); ++i) {
      SourceDatagram datagram;
      datagram.captured = std::as_bytes(std::span(frames[i]));
      datagram.captured_on_wire = frames[i].size();
      datagram.link_type = types[i];
      writer.write(datagram);
    }
  }
  const ReadBack read = read_all(folder.file("a.pcapng"));
  EXPECT_THAT(sizes_of(read), ElementsAre(10, 11, 12, 13));
  for (std::size_t i = 0; i < types.size(); ++i)
    EXPECT_EQ(read.datagrams[i].datagram.link_type, types[i]);
}

/// A classic pcap file of one frame.
void write_pcap(const std::string& path, std::uint32_t snap_length, std::uint32_t link_type,
                std::uint32_t second, const Bytes& frame) {
  const PcapngFile numbers;
  const auto size = static_cast<std::uint32_t>(frame.size());
  Bytes octets;
  for (const std::uint32_t word :
       {0xa1b2c3d4U, 0x00040002U, 0U, 0U, snap_length, link_type, second, 0U, size, size})
    octets = octets + numbers.number(word);
  octets = octets + frame;
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(octets.data()),
             static_cast<std::streamsize>(octets.size()));
}

TEST(Pcapng, IsReadAsMergecapMergesIt) {
  if (std::system("command -v mergecap >/dev/null") != 0) GTEST_SKIP() << "needs mergecap";
  const ScratchFolder folder;
  write_pcap(folder.file("a"), 65535, kEthernet, 1, ethernet(ipv4(udp(10))));
  write_pcap(folder.file("b"), 262144, kEthernet, 2, ethernet(ipv4(udp(11))));
  write_pcap(folder.file("c"), 96, kCooked, 3, cooked(ipv4(udp(12))));
  ASSERT_EQ(std::system(("mergecap -w " + folder.file("m.pcapng") + " " + folder.file("a") + " " +
                         folder.file("b") + " " + folder.file("c"))
                            .c_str()),
            0);
  const ReadBack read = read_all(folder.file("m.pcapng"));
  EXPECT_THAT(sizes_of(read), ElementsAre(10, 11, 12));
  EXPECT_EQ(read.report.problem, "");
}

}  // namespace
}  // namespace reckon::peer
