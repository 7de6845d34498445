// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Datagrams put together from IP fragments: in any order, with copies, gaps and contradictions.
#include "reckon/peer/capture/ip_reassembler.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "reckon/tests/src/support/made_fragments.hpp"

namespace reckon::peer {
namespace {

using namespace frames;
using namespace std::chrono_literals;
using std::chrono::nanoseconds;

/// A datagram that the reassembler returned.
struct Returned {
  std::uint64_t frame;
  Portion portion;
  Bytes bytes;
};

/// Passes frames one after another to a reassembler.
class Feed {
 public:
  explicit Feed(const ReassemblyLimits& limits = {}) : reassembler_(limits) {}

  FragmentFate add(const Bytes& frame, nanoseconds time = 0s, std::size_t on_wire = 0) {
    SourceDatagram datagram;
    datagram.frame = ++frame_;
    datagram.time = time;
    datagram.captured = std::as_bytes(std::span(frame));
    const ParsedFrame parsed =
        parse_frame(LinkLayer::ethernet, datagram.captured, on_wire, datagram);
    EXPECT_EQ(parsed.content, FrameContent::udp);
    EXPECT_TRUE(parsed.fragment.has_value());
    const FragmentFate fate = reassembler_.take(LinkLayer::ethernet, *parsed.fragment, datagram);
    if (fate == FragmentFate::whole || fate == FragmentFate::overlapping) keep(datagram);
    most_octets_ = std::max(most_octets_, reassembler_.octets());
    drain();
    return fate;
  }
  void add(const std::vector<Bytes>& frames, nanoseconds time = 0s) {
    for (const Bytes& frame : frames) add(frame, time);
  }
  void finish() {
    reassembler_.give_up_all();
    drain();
    EXPECT_EQ(reassembler_.octets(), 0U);
  }

  [[nodiscard]] const std::vector<Returned>& returned() const { return returned_; }
  [[nodiscard]] std::vector<Returned> take_returned() { return std::exchange(returned_, {}); }
  [[nodiscard]] FragmentCounts counts() const { return reassembler_.counts(); }
  [[nodiscard]] std::size_t most_octets() const { return most_octets_; }

 private:
  void keep(const SourceDatagram& datagram) {
    const auto* begin = reinterpret_cast<const std::uint8_t*>(datagram.bytes.data());
    returned_.push_back({datagram.frame, datagram.portion, {begin, begin + datagram.bytes.size()}});
  }
  void drain() {
    SourceDatagram lost;
    while (reassembler_.take_lost(lost)) keep(lost);
  }

  IpReassembler reassembler_;
  std::uint64_t frame_ = 0;
  std::size_t most_octets_ = 0;
  std::vector<Returned> returned_;
};

Bytes payload_of(const Bytes& datagram) { return {datagram.begin() + 8, datagram.end()}; }

Bytes first_of(const Bytes& octets, std::size_t count) {
  return {octets.begin(), octets.begin() + static_cast<std::ptrdiff_t>(count)};
}

TEST(IpReassembler, PutsFragmentsInAnyOrderTogether) {
  const Bytes datagram = numbered_udp(7000);
  for (const auto& fragment : {fragment4, fragment6}) {
    std::vector<Bytes> frames = fragments(datagram, 77, fragment);
    ASSERT_EQ(frames.size(), 5U);
    std::vector<std::size_t> order{0, 1, 2, 3, 4};
    do {
      Feed feed;
      for (const std::size_t i : order) feed.add(frames[i]);
      ASSERT_EQ(feed.returned().size(), 1U);
      EXPECT_EQ(feed.returned()[0].portion, Portion::whole);
      EXPECT_EQ(feed.returned()[0].frame, 5U);
      ASSERT_EQ(feed.returned()[0].bytes, payload_of(datagram));
      EXPECT_EQ(feed.counts().frames, 5U);
      EXPECT_EQ(feed.counts().whole, 1U);
    } while (std::next_permutation(order.begin(), order.end()));
  }
}

TEST(IpReassembler, BuildsTheFrameOfTheWholeDatagram) {
  const Bytes datagram = numbered_udp(3000);
  for (const auto& [fragment, whole] : {std::pair{&fragment4, ethernet(ipv4(datagram))},
                                        std::pair{&fragment6, ethernet(ipv6(datagram), 0x86dd)}}) {
    IpReassembler reassembler;
    const std::vector<Bytes> frames = fragments(datagram, 1, fragment);
    SourceDatagram out;
    for (const Bytes& frame : frames) {
      out.captured = std::as_bytes(std::span(frame));
      const ParsedFrame parsed = parse_frame(LinkLayer::ethernet, out.captured, 0, out);
      (void)reassembler.take(LinkLayer::ethernet, *parsed.fragment, out);
    }
    const auto* begin = reinterpret_cast<const std::uint8_t*>(out.captured.data());
    Bytes built(begin, begin + out.captured.size());
    EXPECT_EQ(out.source.text(), fragment == &fragment4 ? "10.0.0.1:3001" : "[fd00::7]:3001");
    EXPECT_EQ(out.group.port, 3000);
    if (fragment == &fragment4) {
      // The expected frame has no checksum.
      EXPECT_NE(built[24] << 8 | built[25], 0);
      built[24] = built[25] = 0;
    }
    EXPECT_EQ(built, whole);
  }
}

TEST(IpReassembler, PutsFragmentsInsideATunnelTogether) {
  const Bytes datagram = numbered_udp(3000);
  for (const auto& fragment : {fragment4, fragment6}) {
    Feed feed;
    for (const Bytes& frame : fragments(datagram, 77, fragment)) feed.add(ethernet(vxlan(frame)));
    ASSERT_EQ(feed.returned().size(), 1U);
    EXPECT_EQ(feed.returned()[0].portion, Portion::whole);
    EXPECT_EQ(feed.returned()[0].bytes, payload_of(datagram));
  }
}

TEST(IpReassembler, OpensATunnelThatWasFragmented) {
  Feed feed;
  const Bytes frame = ethernet(ipv4(udp(3000)));
  const Bytes mirror = erspan(frame, 2);
  feed.add(fragments(Bytes(mirror.begin() + 20, mirror.end()), 77, [](auto&&... of) {
    Bytes made = fragment4(of...);
    made[23] = 47;  // GRE
    return made;
  }));
  ASSERT_EQ(feed.returned().size(), 1U);
  EXPECT_EQ(feed.returned()[0].portion, Portion::whole);
  EXPECT_EQ(feed.returned()[0].bytes, Bytes(3000, 0x5a));
}

TEST(IpReassembler, IsNotDisturbedByCopies) {
  const Bytes datagram = numbered_udp(7000);
  const std::vector<Bytes> frames = fragments(datagram, 3, fragment4);
  Feed feed;
  for (const Bytes& frame : frames) {
    feed.add(frame);
    feed.add(frame);
  }
  feed.add(fragment4(datagram, 3, 8, 2 * kPiece), 50ms);  // a new datagram, not a copy
  feed.add(frames[3], 90ms);
  feed.finish();
  ASSERT_EQ(feed.returned().size(), 2U);
  EXPECT_EQ(feed.returned()[0].bytes, payload_of(datagram));
  EXPECT_EQ(feed.counts().duplicate, 5U);
  EXPECT_EQ(feed.counts().lost, 1U);
}

TEST(IpReassembler, MuchLaterCopyStartsANewDatagram) {
  const std::vector<Bytes> frames = fragments(numbered_udp(7000), 3, fragment4);
  Feed feed;
  feed.add(frames);
  feed.add(frames[1], 100ms);
  EXPECT_EQ(feed.counts().duplicate, 1U);
  feed.add(frames, 101ms);
  EXPECT_EQ(feed.counts().whole, 2U);
  feed.finish();
  EXPECT_EQ(feed.counts().lost, 0U);
}

TEST(IpReassembler, KeepsSendersAndIdentifiersApart) {
  Feed feed;
  std::vector<std::vector<Bytes>> all;
  std::vector<Bytes> wanted;
  for (std::size_t i = 0; i < 6; ++i) {
    const Bytes datagram = numbered_udp(4000, i);
    std::vector<Bytes> frames = fragments(datagram, i % 3, fragment4);
    for (Bytes& frame : frames) frame[29] = i < 3 ? 1 : 2;  // sender 10.0.0.1 or .2
    all.push_back(std::move(frames));
    wanted.push_back(payload_of(datagram));
  }
  for (std::size_t piece = 0; piece < 3; ++piece)
    for (const auto& frames : all) feed.add(frames[piece]);
  feed.finish();
  ASSERT_EQ(feed.returned().size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(feed.returned()[i].bytes, wanted[i]);
}

TEST(IpReassembler, UsesAnIdentifierAgainForTheNextDatagram) {
  Feed feed;
  for (std::size_t i = 0; i < 5; ++i) feed.add(fragments(numbered_udp(3000, i), 0, fragment4));
  feed.finish();
  ASSERT_EQ(feed.returned().size(), 5U);
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_EQ(feed.returned()[i].bytes, payload_of(numbered_udp(3000, i)));
}

TEST(IpReassembler, ReturnsTheBeginningOfAnExpiredDatagram) {
  const Bytes datagram = numbered_udp(7000);
  const std::vector<Bytes> frames = fragments(datagram, 9, fragment4);
  Feed feed({.age = 2s});
  for (const std::size_t i : {0, 1, 3, 4}) feed.add(frames[i], 10s);
  feed.add(fragment4(numbered_udp(2000), 10, 0), 12s);
  EXPECT_TRUE(feed.returned().empty());
  feed.add(fragment4(numbered_udp(2000), 10, kPiece), 12s + 1ns);
  ASSERT_EQ(feed.returned().size(), 2U);
  EXPECT_EQ(feed.returned()[0].portion, Portion::whole);
  EXPECT_EQ(feed.returned()[1].portion, Portion::first_fragment);
  EXPECT_EQ(feed.returned()[1].frame, 1U);
  EXPECT_EQ(feed.returned()[1].bytes, first_of(payload_of(datagram), 2 * kPiece - 8));
  EXPECT_EQ(feed.counts().lost, 1U);

  // The missing fragment arrives too late and belongs to no datagram.
  feed.add(frames[2], 12s + 2ns);
  feed.finish();
  EXPECT_EQ(feed.counts().late, 1U);
  EXPECT_EQ(feed.counts().lost, 1U);
  EXPECT_EQ(feed.returned().size(), 2U);
}

TEST(IpReassembler, ReturnsFragmentsWithoutBeginningOrEnd) {
  const Bytes datagram = numbered_udp(7000);
  for (const auto& fragment : {fragment4, fragment6}) {
    const std::vector<Bytes> frames = fragments(datagram, 9, fragment);
    Feed feed;
    for (const std::size_t i : {1, 2, 3, 4}) feed.add(frames[i]);
    feed.finish();
    ASSERT_EQ(feed.returned().size(), 1U);
    EXPECT_EQ(feed.returned()[0].portion, Portion::later_fragment);
    EXPECT_EQ(feed.returned()[0].bytes, Bytes(datagram.begin() + kPiece, datagram.end()));
    const std::vector<Bytes> others = fragments(datagram, 10, fragment);
    for (const std::size_t i : {0, 1, 2, 3}) feed.add(others[i]);
    feed.finish();
    ASSERT_EQ(feed.returned().size(), 2U);
    EXPECT_EQ(feed.returned()[1].portion, Portion::first_fragment);
    EXPECT_EQ(feed.returned()[1].bytes.size(), 4 * kPiece - 8);
  }
}

TEST(IpReassembler, RefusesADatagramWhoseFragmentsOverlap) {
  const Bytes datagram = numbered_udp(7000);
  const Bytes other = numbered_udp(7000, 1);
  const std::vector<Bytes> contradictions = {
      fragment4(other, 5, kPiece),                    // different octets in the same place
      fragment4(other, 5, kPiece, 1488),              // overlaps the next fragment
      fragment4(other, 5, 1472, 1480),                // overlaps the fragment before
      fragment4(datagram, 5, 8, 8 * 1000),            // overlaps several, up to the end
      fragment4(datagram, 5, 2 * kPiece, 1488),       // reaches into a gap
      fragment4(numbered_udp(1600), 5, kPiece),       // ends before later fragments
      fragment4(numbered_udp(9000), 5, 4 * kPiece)};  // beyond the end
  for (const Bytes& contradiction : contradictions) {
    Feed feed;
    const std::vector<Bytes> frames = fragments(datagram, 5, fragment4);
    for (const std::size_t i : {0, 1, 2, 4}) feed.add(frames[i]);
    EXPECT_EQ(feed.add(contradiction), FragmentFate::overlapping);
    EXPECT_EQ(feed.add(frames[3]), FragmentFate::held);
    feed.finish();
    ASSERT_EQ(feed.returned().size(), 1U);
    EXPECT_EQ(feed.returned()[0].portion, Portion::overlapping_fragment);
    EXPECT_EQ(feed.counts().overlapping, 1U);
    EXPECT_EQ(feed.counts().late, 1U);
    EXPECT_EQ(feed.counts().lost + feed.counts().whole, 0U);
    // The next datagram with the identifier is whole again.
    feed.add(frames);
    EXPECT_EQ(feed.returned().back().bytes, payload_of(datagram));
  }
}

TEST(IpReassembler, RefusesFragmentsThatCannotBe) {
  const Bytes datagram = numbered_udp(7000);
  Feed feed;
  EXPECT_EQ(feed.add(fragment4(datagram, 1, 0, 100)), FragmentFate::malformed);  // no whole words
  const Bytes far = ethernet(ipv4(Bytes(64, 1), 17, 0x1fff));  // 65,528 + 64 octets
  EXPECT_EQ(feed.add(far), FragmentFate::malformed);
  EXPECT_EQ(feed.counts().frames, 0U);
  // The payload fits into 65,535 octets, but not together with its header.
  std::vector<Bytes> frames = fragments(numbered_udp(65'520), 2, fragment4);
  for (std::size_t i = 0; i + 1 < frames.size(); ++i) feed.add(frames[i]);
  EXPECT_EQ(feed.add(frames.back()), FragmentFate::malformed);
  frames = fragments(numbered_udp(65'507), 2, fragment4);
  feed.add(frames);
  EXPECT_EQ(feed.returned().back().bytes.size(), 65'507U);
}

TEST(IpReassembler, ReturnsNothingForReassembledIcmp) {
  // Behind the fragment header: destination options, then ICMP, which only the first fragment
  // shows.
  const Bytes packet = Bytes{58, 0, 0, 0, 0, 0, 0, 0} + Bytes(3000, 5);
  Bytes first = fragment6(packet, 8, 0);
  Bytes last = fragment6(packet, 8, kPiece, 3000);
  first[54] = last[54] = 60;
  SourceDatagram datagram;
  EXPECT_EQ(parse_frame(LinkLayer::ethernet, std::as_bytes(std::span(first)), 0, datagram).content,
            FrameContent::not_udp);
  Bytes udp_first = first;
  udp_first[62] = 17;
  Feed feed;
  feed.add(last);
  feed.add(udp_first);
  feed.finish();
  // The UDP length field is 0x0505, which is within the datagram.
  ASSERT_EQ(feed.returned().size(), 1U);
  EXPECT_EQ(feed.returned()[0].bytes.size(), 0x0505U - 8U);
}

TEST(IpReassembler, ReturnsTheStartOfDatagramsThatWereCut) {
  const Bytes datagram = numbered_udp(3000);
  Feed feed;
  for (const Bytes& frame : fragments(datagram, 1, fragment4)) {
    const Bytes kept = first_of(frame, std::min<std::size_t>(frame.size(), 234));
    feed.add(kept, 0s, frame.size());
  }
  feed.finish();
  ASSERT_EQ(feed.returned().size(), 1U);
  EXPECT_EQ(feed.returned()[0].portion, Portion::first_fragment);
  EXPECT_EQ(feed.returned()[0].bytes, first_of(payload_of(datagram), 192));
}

TEST(IpReassembler, HoldsNoMoreThanItsBounds) {
  std::mt19937 random(5);
  const Bytes datagram = numbered_udp(65'000);
  Feed feed({.octets = 1 << 20, .datagrams = 300});
  for (std::size_t i = 0; i < 20'000; ++i) {
    const std::size_t offset = random() % 8000 * 8;
    feed.add(ethernet(ipv4(Bytes(64, 1), 17, offset / 8 | 0x2000)), nanoseconds(i));
    Bytes spread = fragment4(datagram, random() % 65'536, offset, 8);
    feed.add(spread, nanoseconds(i));
  }
  // A fragment that exceeds the bound is added before the oldest datagram is dropped.
  EXPECT_LE(feed.most_octets(), (1U << 20) + 3 * 65'536U);
  const FragmentCounts before = feed.counts();
  EXPECT_GT(before.lost, 15'000U);
  feed.finish();
  EXPECT_LE(feed.counts().lost - before.lost, 300U);
}

TEST(IpReassembler, GivesUpADatagramInTooManyPieces) {
  const Bytes datagram = numbered_udp(60'000);
  Feed feed;
  for (std::size_t offset = 0; offset < 8000; offset += 16)
    feed.add(fragment4(datagram, 1, offset, 8));
  EXPECT_EQ(feed.counts().lost, 1U);
}

// 14 s, so that IPv4 identifiers wrap.
TEST(IpReassembler, Reassembles5000DatagramsASecondAtOnePercentLoss) {
  std::mt19937 random(17);
  Feed feed;
  constexpr std::size_t kDatagrams = 70'000;
  std::set<std::size_t> hurt;
  std::size_t fragment = 0;
  std::size_t lost_place = random() % 100;
  std::vector<Bytes> frames = fragments(numbered_udp(7000), 0, fragment4);
  std::size_t good = 0;
  for (std::size_t i = 0; i < kDatagrams; ++i) {
    const nanoseconds time = 200us * i;
    for (Bytes& frame : frames) {
      frame[18] = static_cast<std::uint8_t>(i >> 8);
      frame[19] = static_cast<std::uint8_t>(i);
      frame.back() = static_cast<std::uint8_t>(i);
      const bool is_lost = fragment % 100 == lost_place;
      if (++fragment % 100 == 0) lost_place = random() % 100;
      if (is_lost)
        hurt.insert(i);
      else
        feed.add(frame, time);
    }
    for (const Returned& returned : feed.take_returned()) {
      if (returned.portion != Portion::whole) continue;
      ASSERT_EQ(returned.bytes.size(), 7000U);
      ASSERT_EQ(returned.bytes.back(), static_cast<std::uint8_t>(i));
      ++good;
    }
  }
  feed.finish();
  EXPECT_EQ(good, kDatagrams - hurt.size());
  EXPECT_EQ(feed.counts().whole, good);
  EXPECT_EQ(feed.counts().lost, hurt.size());
  EXPECT_EQ(feed.counts().late + feed.counts().overlapping, 0U);
  EXPECT_LE(feed.most_octets(), 16U << 20);
  RecordProperty("most_octets", static_cast<int>(feed.most_octets()));
}

}  // namespace
}  // namespace reckon::peer
