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

// Identifies key and nonce of a datagram.
using KeyAndNonce =
    std::tuple<std::uint16_t, Sealer, std::uint64_t, std::uint32_t, std::uint16_t, std::uint64_t>;
KeyAndNonce key_and_nonce(const Octets& datagram) {
  const EnvelopeHeader header = *read_envelope(datagram);
  return {header.epoch, header.sealer, header.salt, header.stamp, header.stream, header.count};
}

// An opener with its output buffer.
struct Listener {
  explicit Listener(const GroupKey& key, const Sealer& own = {}, const ExercisePlaces& places = {})
      : opener(key, own, places) {}
  SealedVerdict open(const Octets& datagram, std::uint32_t host = 1, nanoseconds now = 1s,
                     const GroupAddress& group = group_of()) {
    last = opener.open(arrived(datagram, address(host), now, group), joined, now, room);
    return last.verdict;
  }
  EnvelopeOpener opener;
  nanoseconds joined = nanoseconds::min();
  std::vector<std::byte> room = std::vector<std::byte>(kMaxDatagram);
  OpenedDatagram last;
};

TEST(EnvelopeOpener, OpensAMembersDatagramOnce) {
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

// bench/sealing_bench.cpp tries 10,000,000 of them.
TEST(EnvelopeOpener, TakesNoneOf100000Forgeries) {
  for (const SealingSuite suite : {fast_suite(), SealingSuite::xchacha20_poly1305}) {
    const GroupKey key = group_key(2, suite);
    Forger forger(key, 208, 5);
    EnvelopeOpener opener(key, {});
    EXPECT_EQ(taken_of(forger, opener, 100000), 0U);
    EXPECT_EQ(opener.senders().size(), 8U) << "a forgery made an entry";
  }
}

TEST(EnvelopeOpener, ForgeriesDoNotMoveItsWindow) {
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

TEST(EnvelopeOpener, RefusesOtherGroupsSuitesStreamsAndItsOwn) {
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

// A host, another group, another port, another address family and broadcast.
TEST(EnvelopeOpener, RefusesOtherPlacesWithoutMovingTheWindow) {
  for (const SealingSuite suite : {fast_suite(), SealingSuite::xchacha20_poly1305}) {
    const GroupKey key = group_key(1, suite);
    EnvelopeSealer sealer(key, 1, 1);
    Listener listener(key);
    ASSERT_EQ(listener.open(sealed(sealer, kPlain)), SealedVerdict::opened);
    const Octets datagram = sealed(sealer, kPlain, SealingStream::datagrams, 0, group_of(3));
    GroupAddress other_port = group_of(3);
    ++other_port.port;
    for (const GroupAddress& place :
         {group_of(), group_of(2), other_port, *IpEndpoint::parse("[ff15::c0:103]:3001"),
          IpEndpoint::v4(0xFFFFFFFF, 3001), address(7)})
      EXPECT_EQ(listener.open(datagram, 1, 1s, place), SealedVerdict::forged) << place.text();
    EXPECT_EQ(listener.last.sender, nullptr);
    EXPECT_EQ(listener.open(datagram, 1, 1s, group_of(3)), SealedVerdict::opened);
  }
}

TEST(EnvelopeOpener, OpensNothingOfAnotherExercise) {
  const GroupKey key = group_key();
  EnvelopeSealer sealer(key, 1, 1, {2, {}});
  const Octets datagram = sealed(sealer, kPlain);
  EXPECT_EQ(Listener(key).open(datagram), SealedVerdict::forged);
  EXPECT_EQ(Listener(key, {}, {2, {}}).open(datagram), SealedVerdict::opened);
}

TEST(EnvelopeOpener, KnowsGroupsByTheirIndexInTheList) {
  const GroupKey key = group_key();
  const ExercisePlaces places{1, GroupPool(group_of(), 8)};
  EnvelopeSealer sealer(key, 1, 1, places);
  Listener listener(key, {}, places);
  const Octets base = sealed(sealer, kPlain);
  const Octets third = sealed(sealer, kPlain, SealingStream::datagrams, 0, group_of(3));
  EXPECT_EQ(listener.open(base, 1, 1s, group_of(3)), SealedVerdict::forged);
  EXPECT_EQ(listener.open(third, 1, 1s, group_of(3)), SealedVerdict::opened);
  EXPECT_EQ(listener.open(base), SealedVerdict::opened);
}

// Receives from one trusted sender.
struct Acquainted : Listener {
  explicit Acquainted(const GroupKey& key) : Listener(key), sealer(key, 1, 1) {
    EXPECT_EQ(open(said(1s), 1, 1s + 1ms), SealedVerdict::opened);
    last.sender->trusted = true;
    last.sender->time.begin(last.header.stamp, 1s + 1ms);
  }
  Octets said(nanoseconds at) {
    return sealed(sealer, kPlain, SealingStream::datagrams, 0, group_of(), at);
  }
  EnvelopeSealer sealer;
};

TEST(EnvelopeOpener, RefusesDatagramsSealedBeforeItsGroupWasJoined) {
  const GroupKey key = group_key();
  Acquainted listener(key);
  const Octets before = listener.said(2s), after = listener.said(2s + 20ms);
  listener.joined = 2s + 10ms;
  EXPECT_EQ(listener.open(before, 1, 2s + 30ms), SealedVerdict::outdated);
  EXPECT_TRUE(listener.last.is_newest);
  EXPECT_EQ(listener.open(after, 1, 2s + 300ms), SealedVerdict::opened) << "late, and of now";
  EXPECT_EQ(listener.open(before, 1, 2s + 310ms), SealedVerdict::outdated);
  EXPECT_FALSE(listener.last.is_newest);
}

TEST(EnvelopeOpener, TakesNothingThatComesASecondLate) {
  const GroupKey key = group_key();
  Acquainted listener(key);
  const Octets one = listener.said(2s), other = listener.said(2s);
  EXPECT_EQ(listener.open(one, 1, 3s + 1ms), SealedVerdict::opened);
  EXPECT_EQ(listener.open(other, 1, 3s + 2ms), SealedVerdict::outdated);
}

// The local clock stood still meanwhile, as on a restored copy of a machine.
TEST(EnvelopeOpener, RefusesDatagramsAheadOfTimeUntilProved) {
  const GroupKey key = group_key();
  Acquainted listener(key);
  EXPECT_EQ(listener.open(listener.said(9s), 1, 1s + 2ms), SealedVerdict::outdated);
  EXPECT_TRUE(listener.last.is_newest);
  listener.last.sender->time.begin(listener.last.header.stamp, 1s + 3ms);
  EXPECT_EQ(listener.open(listener.said(9s + 10ms), 1, 1s + 13ms), SealedVerdict::opened);
}

// The clock drifts by one part in a thousand for an hour.
TEST(EnvelopeOpener, FollowsAClockThatDrifts) {
  const GroupKey key = group_key();
  for (const double rate : {0.999, 1.001}) {
    Acquainted listener(key);
    for (nanoseconds passed = 100ms; passed < 1h; passed += 100ms) {
      const auto theirs =
          nanoseconds(static_cast<std::int64_t>(rate * static_cast<double>(passed.count())));
      ASSERT_EQ(listener.open(listener.said(1s + theirs), 1, 1s + 1ms + passed),
                SealedVerdict::opened);
    }
  }
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

TEST(EnvelopeOpener, GivesNoGraceLongAfterTheChange) {
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
  listener.last.sender->time.begin(listener.last.header.stamp, 1s);
  ASSERT_EQ(listener.open(sealed(sealer, kPlain, SealingStream::datagrams, 1)),
            SealedVerdict::opened);
  EXPECT_EQ(listener.opener.epoch(), 1U);
  listener.opener.follow_time(2s, 0s);
  EXPECT_EQ(listener.opener.epoch(), 1U);
}

TEST(EnvelopeOpener, KeepsFourBootsPerAddressBesideTrustedOnes) {
  const GroupKey key = group_key();
  Listener listener(key);
  EnvelopeSealer victim(key, 1, 1);
  ASSERT_EQ(listener.open(sealed(victim, kPlain)), SealedVerdict::opened);
  listener.last.sender->trusted = true;
  for (int i = 0; i < 20; ++i) {
    EnvelopeSealer recorded(key, 1, 1);
    ASSERT_EQ(listener.open(sealed(recorded, kPlain), 1, 2s), SealedVerdict::opened);
  }
  EXPECT_EQ(listener.opener.senders().size(), 1 + SealedSenders::kMostOfAddress);
  EXPECT_EQ(listener.opener.senders().trusted_dropped(), 0U);
  const SealedSender* kept = listener.opener.senders().find(victim.own());
  ASSERT_NE(kept, nullptr);
  EXPECT_TRUE(kept->trusted);
}

TEST(EnvelopeOpener, IsBoundedAndPrefersTrustedSenders) {
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
  static_cast<void>(sealer.seal(SealingStream::control, 0, group_of(), 1s, kPlain, room));
  EXPECT_EQ(guard.count(), 0U);
}

// bench/sealing_bench.cpp makes 100,000 restarts.
TEST(EnvelopeSealer, NeverReusesKeyAndNonceOverRestarts) {
  const GroupKey key = group_key(2);
  std::set<KeyAndNonce> used;
  std::size_t datagrams = 0;
  for (int restart = 0; restart < 2000; ++restart) {
    EnvelopeSealer sealer(key, 1, 1);
    for (std::size_t i = 0; i < 8; ++i, ++datagrams) {
      const auto stream = i % 2 == 0 ? SealingStream::datagrams : SealingStream::control;
      used.insert(key_and_nonce(sealed(sealer, kPlain, stream, i / 4)));
    }
  }
  EXPECT_EQ(used.size(), datagrams);
}

TEST(EnvelopeSealer, StopsAtTheEndOfItsStream) {
  const GroupKey key = group_key();
  EnvelopeSealer sealer(key, 1, 1);
  sealer.skip_to(SealingStream::datagrams, EnvelopeSealer::kMostOfStream - 1);
  EXPECT_EQ(sealed(sealer, kPlain).size(), kPlain.size() + kEnvelope);
  EXPECT_TRUE(sealed(sealer, kPlain).empty());
  EXPECT_FALSE(sealed(sealer, kPlain, SealingStream::control).empty());
}

}  // namespace
}  // namespace reckon::peer
