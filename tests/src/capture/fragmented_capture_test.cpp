// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A capture of IP fragments, compared with the reassembly of tshark.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
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
using blocks::kEthernet;
using blocks::PcapngFile;
using test::ScratchFolder;

/// Fragments of datagrams of 3,000 to 9,000 octets, alternating IPv4 and IPv6, with copies. Each
/// third datagram lacks one fragment.
std::vector<Bytes> mixed_fragments(std::vector<Bytes>& whole) {
  std::mt19937 random(31);
  std::vector<Bytes> out;
  for (std::size_t round = 0; round < 20; ++round) {
    std::vector<Bytes> frames;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t number = 3 * round + i;
      const Bytes datagram = numbered_udp(3000 + number * 100, number);
      const bool is_v6 = number % 2 == 1;
      std::vector<Bytes> pieces = fragments(datagram, number, is_v6 ? &fragment6 : &fragment4);
      if (i == 2)
        pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(random() % pieces.size()));
      else
        whole.emplace_back(datagram.begin() + 8, datagram.end());
      frames.insert(frames.end(), pieces.begin(), pieces.end());
    }
    frames.push_back(frames[random() % frames.size()]);
    std::shuffle(frames.begin(), frames.end(), random);
    out.insert(out.end(), frames.begin(), frames.end());
  }
  return out;
}

TEST(FragmentedCapture, GivesTheDatagramsThatTsharkPutsTogether) {
  const ScratchFolder folder;
  std::vector<Bytes> whole;
  PcapngFile file;
  file.interface(kEthernet, 65535);
  std::uint64_t stamp = 0;
  for (const Bytes& frame : mixed_fragments(whole)) file.packet(0, stamp += 1000, frame);
  const ReadBack read = read_all(file.write(folder.file("fragments.pcapng")));
  EXPECT_EQ(read.report.fragments.whole, 40U);
  EXPECT_EQ(read.report.fragments.lost, 20U);
  EXPECT_EQ(read.report.fragments.overlapping + read.report.fragments.late, 0U);
  std::string text;
  std::vector<Bytes> found;
  for (const Kept& kept : read.datagrams) {
    if (kept.datagram.portion != Portion::whole) continue;
    const auto* begin = reinterpret_cast<const std::uint8_t*>(kept.bytes.data());
    found.emplace_back(begin, begin + kept.bytes.size());
    text += std::to_string(kept.datagram.frame) + "\t";
    for (const std::byte octet : kept.bytes) {
      constexpr const char* kDigits = "0123456789abcdef";
      text +=
          {kDigits[std::to_integer<int>(octet) >> 4], kDigits[std::to_integer<int>(octet) & 15]};
    }
    text += "\n";
  }
  EXPECT_THAT(found, ::testing::UnorderedElementsAreArray(whole));
  if (std::system("command -v tshark >/dev/null") != 0)
    GTEST_SKIP() << "tshark is not here to judge";
  EXPECT_EQ(output_of("tshark -r " + folder.file("fragments.pcapng") +
                      " -d udp.port==3000,data -Y udp -T fields -e frame.number -e data.data "
                      "2>/dev/null"),
            text);
}

}  // namespace
}  // namespace reckon::peer
