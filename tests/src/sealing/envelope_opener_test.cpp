// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/sealing/envelope_opener.hpp"

#include <gtest/gtest.h>

#include <set>
#include <tuple>
#include <vector>

#include "reckon/tests/src/sealing/sealing_samples.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::peer {
namespace {

using namespace samples;

const Octets kPlain(168, std::byte{42});

// One who opens, and the room that it has.
struct Listener {
  explicit Listener(const GroupKey& key, const Sealer& own = {}) : opener(key, own) {}
  SealedVerdict open(const Octets& datagram, std::uint32_t host = 1, nanoseconds now = 1s) {
    last = opener.open(datagram, address(host), now, room);
    return last.verdict;
  }
  EnvelopeOpener opener;
  std::vector<std::byte> room = std::vector<std::byte>(kMaxDatagram);
  OpenedDatagram last;
};

TEST(EnvelopeOpener, OpensWhatAMemberSealedOnce) {
  const GroupKey key = group_key();
  EnvelopeSealer sealer(key, 3, 4);
  Listener listener(key);
  const Octets datagram = sealed(sealer, kPlain);
  ASSERT_EQ(listener.open(datagram), SealedVerdict::opened);
  EXPECT_TRUE(listener.last.is_new);
  EXPECT_EQ(Octets(listener.last.plain.begin(), listener.last.plain.end()), kPlain);
  EXPECT_EQ(listener.last.sender->sealer, sealer.own());
  EXPECT_EQ(listener.open(datagram), SealedVerdict::replayed);
  EXPECT_EQ(listener.open(sealed(sealer, kPlain)), SealedVerdict::opened);
  EXPECT_FALSE(listener.last.is_new);
}

// 10,000,000 of them in bench/sealing_bench.cpp.
TEST(EnvelopeOpener, TakesNoneOf100000Forgeries) {
  for (const SealingSuite suite : {fast_suite(), SealingSuite::xchacha20_poly1305}) {
    const GroupKey key = group_key(2, suite);
    Forger forger(key, 208, 5);
    EnvelopeOpener opener(key, {});
    EXPECT_EQ(taken_of(forger, opener, 100000), 0U);
    EXPECT_EQ(opener.senders().size(), 8U) << "a forgery made an entry";
  }
}

TEST(EnvelopeOpener, KeepsItsWindowWhateverIsForged) {
  const GroupKey key = group_key();
  EnvelopeSealer sealer(key, 1, 1);
  Listener listener(key);
  ASSERT_EQ(listener.open(sealed(sealer, kPlain)), SealedVerdict::opened);
  Octets ahead = sealed(sealer, kPlain);
  ahead[19] = std::byte{1};  // count + 2^32
  ahead.back() ^= std::byte{1};
  EXPECT_EQ(listener.open(ahead), SealedVerdict::forged);
  EXPECT_EQ(listener.open(sealed(sealer, kPlain)), SealedVerdict::opened);
}

TEST(EnvelopeOpener, RefusesAnotherGroupSuiteAndStreamAndItsOwn) {
  const GroupKey key = group_key();
  EnvelopeSealer sealer(key, 1, 1);
  Listener listener(key);
  EXPECT_EQ(
      Listener(group_key(1, SealingSuite::xchacha20_poly1305, 9)).open(sealed(sealer, kPlain)),
      SealedVerdict::forged);
  EXPECT_EQ(Listener(group_key(1, SealingSuite::aes_256_gcm)).open(sealed(sealer, kPlain)),
            SealedVerdict::other_suite);
  EXPECT_EQ(Listener(key, sealer.own()).open(sealed(sealer, kPlain)), SealedVerdict::own);
  Octets other_stream = sealed(sealer, kPlain);
  other_stream[17] = std::byte{kSealingStreams};
  EXPECT_EQ(listener.open(other_stream), SealedVerdict::no_stream);
  EXPECT_EQ(listener.open(kPlain), SealedVerdict::plain);
  EXPECT_EQ(listener.open({}), SealedVerdict::plain);
}

TEST(EnvelopeOpener, TakesTheEpochBeforeForHalfAMinute) {
  const GroupKey key = group_key(3);
  EnvelopeSealer sealer(key, 1, 1);
  Listener listener(key);
  listener.opener.follow_time(1s, 1h - 1s);
  EXPECT_EQ(listener.opener.epoch(), 0U);
  listener.opener.follow_time(10s, 1h);
  EXPECT_EQ(listener.opener.epoch(), 1U);
  const auto at = [&](std::size_t epoch, nanoseconds now) {
    return listener.open(sealed(sealer, kPlain, SealingStream::datagrams, epoch), 1, now);
  };
  EXPECT_EQ(at(0, 39s), SealedVerdict::opened);
  EXPECT_EQ(at(1, 39s), SealedVerdict::opened);
  EXPECT_EQ(at(0, 41s), SealedVerdict::old_epoch);
  EXPECT_EQ(at(1, 41s), SealedVerdict::opened);
  EXPECT_EQ(Listener(group_key(1)).open(sealed(sealer, kPlain, SealingStream::datagrams, 1)),
            SealedVerdict::unknown_epoch);
}

TEST(EnvelopeOpener, GivesNoGraceWhenItOpensLongAfterTheChange) {
  const GroupKey key = group_key(2);
  EnvelopeSealer sealer(key, 1, 1);
  Listener listener(key);
  listener.opener.follow_time(5s, 2h);
  EXPECT_EQ(listener.open(sealed(sealer, kPlain), 1, 6s), SealedVerdict::old_epoch);
}

TEST(EnvelopeOpener, FollowsATrustedSenderWhoseClockIsAhead) {
  const GroupKey key = group_key(2);
  EnvelopeSealer sealer(key, 1, 1);
  Listener listener(key);
  listener.opener.follow_time(1s, 0s);
  ASSERT_EQ(listener.open(sealed(sealer, kPlain, SealingStream::datagrams, 1)),
            SealedVerdict::opened);
  EXPECT_EQ(listener.opener.epoch(), 0U) << "one that may be a recording leads nobody";
  listener.last.sender->trusted = true;
  ASSERT_EQ(listener.open(sealed(sealer, kPlain, SealingStream::datagrams, 1)),
            SealedVerdict::opened);
  EXPECT_EQ(listener.opener.epoch(), 1U);
  listener.opener.follow_time(2s, 0s);
  EXPECT_EQ(listener.opener.epoch(), 1U);
}

TEST(EnvelopeOpener, KeepsFourBootsOfAnAddressAndTheTrustedOneAmongThem) {
  const GroupKey key = group_key();
  Listener listener(key);
  EnvelopeSealer victim(key, 1, 1);
  ASSERT_EQ(listener.open(sealed(victim, kPlain)), SealedVerdict::opened);
  listener.last.sender->trusted = true;
  for (int i = 0; i < 20; ++i) {
    EnvelopeSealer recorded(key, 1, 1);
    ASSERT_EQ(listener.open(sealed(recorded, kPlain), 1, 2s), SealedVerdict::opened);
  }
  EXPECT_EQ(listener.opener.senders().size(), SealedSenders::kMostOfAddress);
  EXPECT_EQ(listener.opener.senders().trusted_dropped(), 0U);
  const SealedSender* kept = listener.opener.senders().find(victim.own());
  ASSERT_NE(kept, nullptr);
  EXPECT_TRUE(kept->trusted);
}

TEST(EnvelopeOpener, IsBoundedAndPrefersWhomItTrusts) {
  const GroupKey key = group_key();
  Listener listener(key);
  EnvelopeSealer trusted(key, 1, 1);
  ASSERT_EQ(listener.open(sealed(trusted, kPlain), 1), SealedVerdict::opened);
  listener.last.sender->trusted = true;
  for (std::uint32_t i = 0; i < SealedSenders::kMost + 100; ++i) {
    EnvelopeSealer other(key, 1, 2);
    ASSERT_EQ(listener.open(sealed(other, kPlain), 2 + i, 2s), SealedVerdict::opened);
  }
  EXPECT_EQ(listener.opener.senders().size(), SealedSenders::kMost);
  EXPECT_NE(listener.opener.senders().find(trusted.own()), nullptr);
}

TEST(EnvelopeOpener, TakesNoHeap) {
  const GroupKey key = group_key(2, fast_suite());
  EnvelopeSealer sealer(key, 1, 1);
  Listener listener(key);
  std::vector<Octets> datagrams;
  for (std::size_t i = 0; i < 8; ++i)
    datagrams.push_back(sealed(sealer, kPlain, SealingStream::datagrams, i % 2));
  datagrams.push_back(datagrams[0]);
  datagrams.push_back(Octets(100, std::byte{kSealedOctet}));
  Octets room(kMaxDatagram);
  const test::AllocationGuard guard;
  for (const Octets& datagram : datagrams) listener.open(datagram);
  static_cast<void>(sealer.seal(SealingStream::control, 0, kPlain, room));
  EXPECT_EQ(guard.count(), 0U);
}

// 100,000 in bench/sealing_bench.cpp.
TEST(EnvelopeSealer, NeverSealsTwiceUnderOneKeyAndNonceOverRestarts) {
  const GroupKey key = group_key(2);
  std::set<std::tuple<std::uint16_t, Sealer, std::uint16_t, std::uint64_t>> used;
  std::size_t datagrams = 0;
  for (int restart = 0; restart < 2000; ++restart) {
    EnvelopeSealer sealer(key, 1, 1);
    for (std::size_t i = 0; i < 8; ++i, ++datagrams) {
      const auto stream = i % 2 == 0 ? SealingStream::datagrams : SealingStream::control;
      const EnvelopeHeader header = *read_envelope(sealed(sealer, kPlain, stream, i / 4));
      used.emplace(header.epoch, header.sealer, header.stream, header.count);
    }
  }
  EXPECT_EQ(used.size(), datagrams);
}

TEST(EnvelopeSealer, SealsNoMoreAtTheEndOfItsStream) {
  const GroupKey key = group_key();
  EnvelopeSealer sealer(key, 1, 1);
  sealer.skip_to(SealingStream::datagrams, EnvelopeSealer::kMostOfStream - 1);
  EXPECT_EQ(sealed(sealer, kPlain).size(), kPlain.size() + kEnvelope);
  EXPECT_TRUE(sealed(sealer, kPlain).empty());
  EXPECT_FALSE(sealed(sealer, kPlain, SealingStream::control).empty());
}

}  // namespace
}  // namespace reckon::peer
