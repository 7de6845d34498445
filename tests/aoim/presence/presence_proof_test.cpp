// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// An identity stays with its owner: while it is cut off, when it returns, and when its address
// changes. The attacker receives all datagrams at its place and sends from an address of its own.
#include <gtest/gtest.h>

#include <string>

#include "reckon/tests/aoim/support/segment.hpp"

namespace reckon::aoim {
namespace {

using namespace test;

constexpr std::size_t kVictim = 0, kPeers = 4, kBeside = 1;  // the attacker is next to this peer
constexpr PeerId kName{7, 1};
constexpr std::uint32_t kEpoch = 101;
const SourceAddress kAttacker = source(66, 6666);

struct Theft {
  std::int64_t outage_ms, attack_ms, gap_ms;
  std::uint64_t seed;
};

std::string name_of(const testing::TestParamInfo<Theft>& info) {
  return "Outage" + std::to_string(info.param.outage_ms) + "Gap" +
         std::to_string(info.param.gap_ms);
}

class Stolen : public testing::TestWithParam<Theft> {
 protected:
  explicit Stolen(double loss = 0.0, std::uint64_t seed = 1) : segment_(seed, loss) {
    for (std::uint16_t i = 1; i <= kPeers; ++i) segment_.add(presence_of(i, 100u + i));
    segment_.on_said = [this](std::size_t from, const pdu::Presence& said) {
      if (from == kVictim && !is_cut_) last_ = said;
    };
    segment_.on_event = [this](std::size_t to, const PresenceEvent& event) {
      if (event.kind != Kind::impostor || to == kVictim) return;
      EXPECT_EQ(event.other, kAttacker) << "the one who cannot prove it is told";
      EXPECT_NE(event.source, kAttacker);
      ++impostors_;
    };
    segment_.run(seconds(5));
  }
  void cut(bool is_cut) {
    is_cut_ = is_cut;
    segment_.cut([is_cut](std::size_t from, std::size_t to) {
      return is_cut && (from == kVictim) != (to == kVictim);
    });
  }
  [[nodiscard]] bool all_know_the_victim(const SourceAddress& at) {
    for (std::size_t i = 1; i < kPeers; ++i) {
      if (segment_[i].epoch_of(kName) != kEpoch || segment_[i].source_of(kEpoch) != at)
        return false;
    }
    return true;
  }
  // Time until that holds; `limit` if it does not.
  [[nodiscard]] nanoseconds known_after(const SourceAddress& at, nanoseconds limit) {
    const nanoseconds begin = segment_.now();
    while (!all_know_the_victim(at) && segment_.now() - begin < limit)
      segment_.run(milliseconds(1));
    return segment_.now() - begin;
  }

  Segment segment_;
  pdu::Presence last_;  // of the victim, as received by the attacker
  bool is_cut_ = false;
  std::size_t impostors_ = 0;
};

// The same epoch, as the attacker received it, and guesses of the next link.
TEST_P(Stolen, VictimsEpochIsRefusedFromAnotherAddress) {
  const auto [outage_ms, attack_ms, gap_ms, seed] = GetParam();
  std::mt19937_64 random(seed);
  cut(true);
  for (std::int64_t ms = 0; ms < attack_ms; ms += gap_ms) {
    pdu::Presence forged = last_;
    forged.chain_number += static_cast<std::uint32_t>(random() % 4);
    if (random() % 2 == 0) forged.chain_link[random() % 16] ^= 1;
    if (ms >= outage_ms && is_cut_) cut(false);
    segment_.inject(random() % 8 == 0 ? leaving(forged) : forged, kAttacker, kBeside);
    segment_.run(milliseconds(gap_ms));
    for (std::size_t i = 1; i < kPeers; ++i) {
      EXPECT_NE(segment_[i].source_of(kEpoch), kAttacker) << ms << " ms";
      EXPECT_NE(segment_[i].standing(kEpoch, &kAttacker), Standing::member) << ms << " ms";
    }
    if (ms < outage_ms + 600) continue;
    EXPECT_TRUE(all_know_the_victim(Segment::source_of(kVictim))) << ms;
  }
  EXPECT_GT(impostors_, 0u);
  EXPECT_EQ(segment_.count(kVictim, Kind::identity_changed), 0u);
}

// An epoch of the attacker's own under the victim's id, correctly proved.
TEST_P(Stolen, IdReturnsToItsOwnerAtOnce) {
  const auto [outage_ms, attack_ms, gap_ms, seed] = GetParam();
  LifeChain chain({scrambled, nullptr}, {static_cast<std::uint8_t>(99 + seed)});
  const auto speak = [&] {
    pdu::Presence own = established(presence_of(1, 5000));
    chain.sign(own, {}, segment_.now());
    segment_.inject(own, kAttacker, kBeside);
    segment_.run(milliseconds(gap_ms));
  };
  cut(true);
  for (std::int64_t ms = 0; ms < outage_ms; ms += gap_ms) {
    speak();
    if (ms > 3500) continue;  // its last datagram may have been sent 0.75 s earlier
    for (std::size_t i = 1; i < kPeers; ++i) EXPECT_EQ(segment_[i].epoch_of(kName), kEpoch) << ms;
  }
  cut(false);
  const nanoseconds back = segment_.now();
  while (!all_know_the_victim(Segment::source_of(kVictim)) && segment_.now() - back < seconds(3))
    speak();
  EXPECT_LE(segment_.now() - back, milliseconds(1050 + gap_ms)) << "with its next announcement";
  for (std::int64_t ms = 0; ms < attack_ms; ms += gap_ms) {
    speak();
    EXPECT_TRUE(all_know_the_victim(Segment::source_of(kVictim)));
  }
  EXPECT_EQ(segment_.count(kVictim, Kind::identity_changed), 0u);
}

INSTANTIATE_TEST_SUITE_P(Outages, Stolen,
                         testing::Values(Theft{3100, 9000, 50, 1}, Theft{4100, 14'000, 20, 2},
                                         Theft{5900, 14'000, 7, 3}, Theft{7000, 15'000, 50, 4},
                                         Theft{12'000, 20'000, 90, 5}),
                         name_of);

class Moving : public Stolen {};

TEST_F(Moving, QuietPeersMoveIsAcceptedWithinTwoSeconds) {
  nanoseconds longest{0};
  for (std::uint8_t i = 0; i < 40; ++i) {
    segment_.run(milliseconds(3000 + 131 * i));
    const SourceAddress to = source(static_cast<std::uint8_t>(100 + i));
    segment_.move(kVictim, to);
    segment_[kVictim].note_own_source(to, segment_.now());
    longest = std::max(longest, known_after(to, seconds(3)));
  }
  EXPECT_LT(longest, seconds(2));
  EXPECT_EQ(segment_.count(1, Kind::moved), 40u);
  EXPECT_EQ(segment_.count(1, Kind::timed_out) + segment_.count(1, Kind::departed), 0u);
}

TEST_F(Moving, ChangeDuringAnOutageIsAcceptedAfterIt) {
  cut(true);
  segment_.run(milliseconds(4300));
  segment_.move(kVictim, source(101));
  cut(false);
  segment_[kVictim].note_own_source(source(101), segment_.now());
  EXPECT_LT(known_after(source(101), seconds(3)), seconds(2));
}

// Two links that alternate, slower and faster than a change is accepted.
TEST_F(Moving, BetweenTwoAddressesNeitherDropsNorRenames) {
  for (const std::int64_t every_ms : {2500, 700, 150}) {
    for (int i = 0; i < 20; ++i) {
      const SourceAddress to = source(i % 2 == 0 ? 101 : 102);
      segment_.move(kVictim, to);
      segment_[kVictim].note_own_source(to, segment_.now());
      segment_.run(milliseconds(every_ms));
    }
    EXPECT_LT(known_after(source(102), seconds(5)), seconds(3)) << every_ms << " ms";
  }
  EXPECT_LE(segment_.count(1, Kind::moved), 60u);
  EXPECT_EQ(segment_.count(1, Kind::timed_out) + segment_.count(1, Kind::departed), 0u);
  EXPECT_EQ(segment_.count(kVictim, Kind::identity_changed), 0u);
  EXPECT_EQ(impostors_, 0u);
}

class Relayed : public Stolen {
 protected:
  Relayed() : Stolen(0.2, 9) {}
};

// The attacker repeats all announcements of the victim at once. One in five of the victim's own is
// lost.
TEST_F(Relayed, RepeaterGetsNoIdWhileItsOwnerSends) {
  segment_.on_said = [this](std::size_t from, const pdu::Presence& said) {
    if (from == kVictim) segment_.inject(said, kAttacker, kBeside);
  };
  for (int ms = 0; ms < 60'000; ms += 50) {
    segment_.run(milliseconds(50));
    for (std::size_t i = 1; i < kPeers; ++i) {
      segment_[i].note_alive(kEpoch, segment_.now());  // updates of its hand
      EXPECT_NE(segment_[i].source_of(kEpoch), kAttacker) << ms;
    }
  }
}

TEST_F(Moving, OneWayOutageGivesNothingToARelay) {
  segment_.on_said = [this](std::size_t from, const pdu::Presence& said) {
    if (from == kVictim && is_cut_) segment_.inject(said, kAttacker, kBeside);
  };
  cut(true);
  for (int i = 0; i < 50; ++i) {
    segment_.run(milliseconds(100));
    EXPECT_TRUE(all_know_the_victim(Segment::source_of(kVictim)));
  }
  EXPECT_GT(impostors_, 0u);
  cut(false);
  segment_.run(seconds(5));
  EXPECT_TRUE(all_know_the_victim(Segment::source_of(kVictim)));
}

TEST_F(Moving, ForgedDepartureFromVictimsAddressNeedsProof) {
  for (int i = 0; i < 10; ++i) {
    pdu::Presence forged = last_;
    forged.chain_number += 1;
    segment_.inject(leaving(forged), Segment::source_of(kVictim), kBeside);
    forged.simulation.application = 77;
    segment_.inject(forged, Segment::source_of(kVictim), kBeside);
    segment_.run(milliseconds(200));
    EXPECT_TRUE(all_know_the_victim(Segment::source_of(kVictim)));
  }
}

TEST_F(Moving, ReplayedOldDepartureRemovesNobody) {
  pdu::Presence goodbye;
  segment_.on_said = [&](std::size_t from, const pdu::Presence& said) {
    if (from == 3) goodbye = said;
  };
  segment_[3].stop();
  segment_.run(milliseconds(100));
  segment_.kill(3);
  segment_.run(seconds(2));
  ASSERT_TRUE(goodbye.flags & pdu::kPresenceLeaving);
  segment_.inject(goodbye, kAttacker, kBeside);
  segment_.inject(goodbye, Segment::source_of(3), kBeside);
  segment_.run(seconds(2));
  EXPECT_EQ(segment_.count(1, Kind::departed), 1u);
  EXPECT_FALSE(segment_[1].epoch_of({7, 4}).has_value());
}

}  // namespace
}  // namespace reckon::aoim
