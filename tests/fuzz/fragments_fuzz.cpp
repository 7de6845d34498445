// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Any series of IP fragments: a reassembled datagram contains the true octets or the injected false
// ones, memory stays within its bounds, and every fragment is counted.
//
// Five octets of the input are one fragment: identifier and flags, offset, size, a time step, and
// an offset added to its octets (mostly zero: true octets).
#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <vector>

#include "reckon/peer/capture/ip_reassembler.hpp"
#include "reckon/tests/fuzz/fuzz_target.hpp"

namespace reckon::fuzz {
namespace {

using Octets = std::span<const std::byte>;
using peer::FragmentFate;

constexpr std::size_t kStep = 5;
constexpr peer::ReassemblyLimits kLimits{std::chrono::seconds(5), 6000, 4};
constexpr std::size_t kHeader = 20;
constexpr std::size_t kUdpPort = 3000;

/// The true octet at a position of the datagram: a UDP header of 600 octets, then numbers.
std::byte truth(std::size_t at) {
  constexpr std::array<unsigned, 8> kHead{
      kUdpPort >> 8, kUdpPort & 0xff, kUdpPort >> 8, kUdpPort & 0xff, 600 >> 8, 600 & 0xff, 0, 0};
  return static_cast<std::byte>(at < kHead.size() ? kHead[at] : at * 7 + at / 256);
}

void put_u16(std::byte* at, std::size_t value) {
  at[0] = static_cast<std::byte>(value >> 8);
  at[1] = static_cast<std::byte>(value);
}

class Run {
 public:
  void add(Octets step) {
    const auto number = [&](std::size_t i) { return std::to_integer<std::size_t>(step[i]); };
    const bool has_more = (number(0) & 4) != 0;
    const std::size_t offset = 8 * (number(1) % 80);
    std::size_t size = 1 + number(2) % 200;
    if ((number(0) & 8) == 0) size = std::max<std::size_t>(8, size / 8 * 8);
    time_ += std::chrono::milliseconds(10 * number(3));
    const std::size_t lie = number(4) < 192 ? 0 : number(4) - 191;
    frame_.assign(kHeader + size, std::byte{0});
    frame_[0] = std::byte{0x45};
    put_u16(frame_.data() + 2, frame_.size());
    put_u16(frame_.data() + 4, number(0) & 3);
    put_u16(frame_.data() + 6, offset / 8 | (has_more ? 0x2000U : 0U));
    frame_[9] = std::byte{17};
    for (std::size_t i = 0; i < size; ++i)
      frame_[kHeader + i] = static_cast<std::byte>(std::to_integer<std::size_t>(truth(offset + i)) +
                                                   (offset + i < 8 ? 0 : lie));
    has_lied_ |= lie != 0;
    take();
  }
  void finish() {
    reassembler_.give_up_all();
    drain();
    require(reassembler_.octets() == 0, "octets are held for no datagram");
    const peer::FragmentCounts& counts = reassembler_.counts();
    require(counts.frames + refused_ == fragments_, "a fragment is in no count");
    require(counts.whole == whole_ && counts.lost == lost_, "a datagram is in no count");
  }

 private:
  void take() {
    peer::SourceDatagram datagram;
    datagram.time = time_;
    datagram.captured = frame_;
    const peer::ParsedFrame parsed =
        parse_frame(peer::LinkLayer::raw_ip, frame_, frame_.size(), datagram);
    if (!parsed.fragment) return;
    ++fragments_;
    const FragmentFate fate =
        reassembler_.take(peer::LinkLayer::raw_ip, *parsed.fragment, datagram);
    if (fate == FragmentFate::not_udp || fate == FragmentFate::malformed) ++refused_;
    require(reassembler_.octets() <= kLimits.octets, "more octets are held than may be");
    if (fate == FragmentFate::whole) check_whole(datagram);
    drain();
  }
  void check_whole(const peer::SourceDatagram& datagram) {
    ++whole_;
    require(datagram.portion == peer::Portion::whole, "a whole datagram is none");
    require(datagram.bytes.size() == 592, "a whole datagram has another length than its header");
    if (has_lied_) return;
    for (std::size_t i = 0; i < datagram.bytes.size(); ++i)
      require(datagram.bytes[i] == truth(8 + i), "an octet is in another place than its own");
  }
  void drain() {
    peer::SourceDatagram lost;
    while (reassembler_.take_lost(lost)) {
      ++lost_;
      require(!lost.bytes.empty() || lost.portion == peer::Portion::first_fragment,
              "a datagram that was given up has no octets");
      if (has_lied_ || lost.portion != peer::Portion::first_fragment) continue;
      for (std::size_t i = 0; i < lost.bytes.size(); ++i)
        require(lost.bytes[i] == truth(8 + i), "an octet is in another place than its own");
    }
  }

  peer::IpReassembler reassembler_{kLimits};
  std::chrono::nanoseconds time_{};
  std::vector<std::byte> frame_;
  bool has_lied_ = false;
  std::uint64_t fragments_ = 0, refused_ = 0, whole_ = 0, lost_ = 0;
};

}  // namespace

void check(std::span<const std::byte> input) {
  Run run;
  for (; input.size() >= kStep; input = input.subspan(kStep)) run.add(input.first(kStep));
  run.finish();
}

}  // namespace reckon::fuzz
