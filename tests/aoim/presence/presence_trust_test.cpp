// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Trust of presence: accepted sources, limits of the table, and mutual reception.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "reckon/aoim/bundling/aggregator.hpp"
#include "reckon/pdu/reckon/datagram_trailer.hpp"
#include "reckon/pdu/reckon/peers_heard.hpp"
#include "reckon/pdu/reckon/presence_pdu.hpp"
#include "reckon/pdu/reckon/time_exchange.hpp"
#include "reckon/tests/aoim/support/segment.hpp"

namespace reckon::aoim {
namespace {

using namespace test;

TEST(PresencePins, RefuseAPeerFromAnotherAddressOrPort) {
  for (const SourceAddress& other : {source(3), source(2, 4001), SourceAddress{}}) {
    Presence presence({}, presence_of(1, 11));
    presence.receive(presence_of(2, 22), seconds(1), source(2));
    (void)presence.take_events();
    presence.receive(presence_of(9, 22), seconds(2), other);
    presence.receive(leaving(presence_of(2, 22)), seconds(2), other);
    EXPECT_EQ(presence.epoch_of({7, 2}), 22u);
    EXPECT_EQ(presence.source_of(22), source(2));
    EXPECT_EQ(presence.standing(22, &other), Standing::impostor);
    EXPECT_EQ(presence.counts().impostors, 2u);
    const auto events = presence.take_events();
    ASSERT_EQ(events.size(), 1u) << "told once";
    EXPECT_EQ(events[0].kind, Kind::impostor);
    EXPECT_EQ(events[0].source, source(2));
    EXPECT_EQ(events[0].other, other);
  }
}

TEST(PresencePins, UnprovedPeerMayMoveAfterThreeSilentSeconds) {
  Presence presence({}, presence_of(1, 11));
  presence.receive(presence_of(2, 22), seconds(1), source(2));
  presence.receive(presence_of(2, 22), seconds(4), source(3));
  EXPECT_EQ(presence.source_of(22), source(2));
  presence.receive(leaving(presence_of(2, 22)), seconds(4) + milliseconds(1), source(3));
  presence.receive(presence_of(2, 22), seconds(4) + milliseconds(2), source(3));
  EXPECT_EQ(presence.source_of(22), source(3));
  EXPECT_EQ(presence.epoch_of({7, 2}), 22u);
}

TEST(PresencePins, UnknownAddressPinsNothing) {
  Presence presence({}, presence_of(1, 11));
  presence.receive(presence_of(2, 22), seconds(1));
  presence.receive(presence_of(2, 22), seconds(2), source(2));
  EXPECT_EQ(presence.source_of(22), source(2));
  EXPECT_EQ(presence.counts().impostors, 0u);
}

// A peer that has proved to be boot `boot`, at host `host`.
SourceAddress sealed_source(std::uint8_t host, std::uint64_t boot) {
  SourceAddress from = source(host);
  from.boot = boot;
  return from;
}

TEST(PresencePins, SealedPeerIsItsBootFromAnyAddress) {
  Presence presence({}, presence_of(1, 11));
  presence.receive(presence_of(2, 22), seconds(1), sealed_source(2, 7));
  presence.receive(presence_of(2, 22), seconds(1) + milliseconds(1), sealed_source(3, 7));
  EXPECT_EQ(presence.counts().impostors, 0u);
  EXPECT_EQ(presence.source_of(22)->octets, source(3).octets) << "told with its address of now";
  const SourceAddress third = sealed_source(4, 7), another = sealed_source(2, 8);
  EXPECT_EQ(presence.standing(22, &third), Standing::member);
  EXPECT_EQ(presence.standing(22, &another), Standing::impostor) << "of the same address";
  const SourceAddress unsealed = source(3);
  EXPECT_EQ(presence.standing(22, &unsealed), Standing::impostor);
}

TEST(PresenceRoom, OneSenderCannotFillTheTable) {
  PresenceConfig config;
  Presence presence(config, presence_of(1, 11));
  for (std::uint16_t i = 0; i < 1000; ++i) {
    const auto port = static_cast<std::uint16_t>(4000 + i % 100);
    const auto now = seconds(1) + milliseconds(i);
    presence.receive(presence_of(static_cast<std::uint16_t>(100 + i), 1000u + i), now,
                     source(66, port));
    presence.receive(presence_of(static_cast<std::uint16_t>(100 + i), 1000u + i), now,
                     source(66, port));
  }
  EXPECT_EQ(presence.peers().size(), config.capacity / 2);
  EXPECT_GT(presence.counts().crowd, 0u);
  std::size_t told = 0;
  for (const Kind kind : kinds(presence)) told += kind == Kind::crowd ? 1 : 0;
  EXPECT_EQ(told, 1u);
  presence.receive(presence_of(2, 22), seconds(3), source(2));
  EXPECT_EQ(presence.epoch_of({7, 2}), 22u);
}

TEST(PresenceRoom, OneSourceHoldsALimitedNumberOfRows) {
  PresenceConfig config;
  Presence presence(config, presence_of(1, 11));
  for (std::uint16_t i = 0; i < 200; ++i) {
    presence.receive(presence_of(static_cast<std::uint16_t>(100 + i), 1000u + i), seconds(1),
                     source(66));
  }
  EXPECT_EQ(presence.peers().size(), config.per_source);
}

TEST(PresenceRoom, NewcomersReplacePeersAnnouncedOnlyOnce) {
  PresenceConfig config;
  config.capacity = 8;
  Presence presence(config, presence_of(1, 11));
  for (std::uint8_t i = 0; i < 8; ++i) {
    presence.receive(presence_of(10u + i, 100u + i), seconds(1), source(10 + i));
    if (i < 4) presence.note_alive(100u + i, seconds(1) + milliseconds(100));
  }
  presence.receive(presence_of(2, 22), seconds(1) + milliseconds(200), source(2));
  EXPECT_EQ(presence.epoch_of({7, 2}), std::nullopt) << "they may announce themselves yet";
  presence.receive(presence_of(2, 22), seconds(1) + milliseconds(350), source(2));
  EXPECT_EQ(presence.epoch_of({7, 2}), 22u);
  for (std::uint16_t i = 0; i < 4; ++i) {
    EXPECT_EQ(presence.epoch_of({7, static_cast<std::uint16_t>(10 + i)}), 100u + i);
  }
  EXPECT_EQ(presence.peers().size(), 8u);
}

// Peers of invented addresses, one of each, which keep announcing themselves.
void announce_invented(Presence& presence, std::uint32_t count, nanoseconds now) {
  for (std::uint32_t i = 0; i < count; ++i) {
    SourceAddress from = source(static_cast<std::uint8_t>(i % 250));
    from.octets[13] = static_cast<std::uint8_t>(100 + i / 250);
    presence.receive(presence_of(static_cast<std::uint16_t>(100 + i), 100'000u + 7 * i), now, from);
  }
}

TEST(PresenceRoom, TableFullOfForgedPeersAdmitsNewcomers) {
  const PresenceConfig config;
  Presence presence(config, presence_of(1, 11));
  presence.start(seconds(1));
  presence.receive(presence_of(2, 22), seconds(1), source(2));
  for (int s = 1; s <= 5; ++s) {
    const Octets heard = record_octets(pdu::PeerEpoch{11});
    pdu::PeersHeard list;
    list.epoch = 22;
    list.epochs = heard;
    presence.receive(list, seconds(s), source(2));
    presence.note_alive(22, seconds(s));
    announce_invented(presence, 2 * static_cast<std::uint32_t>(config.capacity), seconds(s));
    (void)presence.step(seconds(s));
    (void)presence.take_events();
  }
  EXPECT_EQ(presence.peers().size(), config.capacity);
  presence.receive(presence_of(3, 33), seconds(5) + milliseconds(500), source(3));
  EXPECT_EQ(presence.epoch_of({7, 3}), 33u);
  EXPECT_EQ(presence.epoch_of({7, 2}), 22u);
}

TEST(PresenceRoom, HoldsAThousandPeersOfSomeHosts) {
  Presence presence({}, presence_of(1, 11));
  for (std::uint16_t i = 0; i < 1000; ++i) {
    const auto port = static_cast<std::uint16_t>(4000 + i);
    presence.receive(presence_of(static_cast<std::uint16_t>(100 + i), 5000u - i), seconds(1),
                     source(static_cast<std::uint8_t>(i % 3), port));
  }
  ASSERT_EQ(presence.peers().size(), 1000u);
  for (std::uint16_t i = 0; i < 1000; i += 2) {
    const auto port = static_cast<std::uint16_t>(4000 + i);
    presence.receive(leaving(presence_of(static_cast<std::uint16_t>(100 + i), 5000u - i)),
                     seconds(2), source(static_cast<std::uint8_t>(i % 3), port));
  }
  for (std::uint16_t i = 0; i < 1000; ++i) {
    const PeerId id{7, static_cast<std::uint16_t>(100 + i)};
    EXPECT_EQ(presence.epoch_of(id), i % 2 == 0 ? std::nullopt : std::optional(5000u - i));
  }
}

TEST(PresenceRoom, ClaimFloodIsBounded) {
  const PresenceConfig config;
  Presence presence(config, presence_of(1, 11));
  presence.start(seconds(1));
  for (std::uint32_t i = 0; i < 2 * config.claims; ++i) {
    SourceAddress from = source(static_cast<std::uint8_t>(i % 250));
    from.octets[13] = static_cast<std::uint8_t>(100 + i / 250);
    presence.receive(presence_of(1, 1000u + i), seconds(1), from);
  }
  EXPECT_EQ(presence.counts().table_full, config.claims);
}

TEST(PresenceRoom, NameFloodIsAnsweredTenTimesASecond) {
  Presence presence({}, presence_of(1, 11));
  presence.start(seconds(0));
  std::size_t announced = 0;
  for (int ms = 0; ms < 10'000; ++ms) {
    for (std::uint32_t i = 0; i < 10; ++i) {
      const auto number = static_cast<std::uint16_t>(2 + (10 * ms + i) % 60'000);
      presence.receive(presence_of(number, 1000u + 10 * ms + i), milliseconds(ms), source(66));
    }
    announced += presence.step(milliseconds(ms)).size();
    (void)presence.take_events();
  }
  EXPECT_LE(announced, 100u);
}

TEST(PresenceHearing, SuspendedPeerReportsOnlyItsOwnSleep) {
  Segment segment(1, 0.0);
  for (std::uint16_t i = 1; i <= 3; ++i) segment.add(presence_of(i, 100u + i));
  segment.run(seconds(5));
  segment.pause(0);
  segment.run(seconds(5));
  segment.go_on(0);
  segment.run(seconds(5));
  EXPECT_EQ(segment.count(Kind::timed_out), 0u);
  EXPECT_EQ(segment.count(0, Kind::quiet), 0u);
  EXPECT_EQ(segment.count(0, Kind::slept), 1u);
  EXPECT_EQ(segment.count(1, Kind::quiet), 1u);
  EXPECT_EQ(segment.count(Kind::slept), 1u);
  EXPECT_TRUE(segment.agree());
}

TEST(PresenceHearing, SuspendedPeerWithoutAQueueGrantsOthersTime) {
  Presence presence({}, presence_of(1, 11));
  presence.start(seconds(0));
  (void)presence.step(seconds(0));
  presence.receive(presence_of(2, 22), milliseconds(500));
  (void)presence.step(seconds(1));
  (void)presence.take_events();
  (void)presence.step(seconds(21));
  const auto events = presence.take_events();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, Kind::slept);
  EXPECT_EQ(events[0].slept, seconds(20));
  EXPECT_EQ(presence.peers().size(), 1u);
}

TEST(PresenceHearing, QueuedDatagramsAreNotDatedInTheFuture) {
  Presence presence({}, presence_of(1, 11));
  presence.start(seconds(0));
  presence.receive(presence_of(2, 22), milliseconds(500));
  (void)presence.step(seconds(1));
  presence.note_alive(22, seconds(6));
  (void)presence.step(seconds(6));
  EXPECT_EQ(presence.peers()[0].last_heard, seconds(6));
}

TEST(PresenceHearing, BothSidesReportOneWayCutAndEnd) {
  Segment segment(2, 0.0);
  for (std::uint16_t i = 1; i <= 3; ++i) segment.add(presence_of(i, 100u + i));
  segment.run(seconds(5));
  segment.cut([](std::size_t from, std::size_t to) { return from == 0 && to == 1; });
  segment.run(seconds(3));
  EXPECT_EQ(segment.count(0, Kind::unheard), 1u) << "1 does not hear 0, and says so";
  EXPECT_EQ(segment.count(1, Kind::quiet), 1u);
  EXPECT_EQ(segment.count(2, Kind::unheard) + segment.count(2, Kind::quiet), 0u);
  EXPECT_EQ(segment.count(Kind::heard_again), 0u);
  segment.cut({});
  segment.run(seconds(3));
  EXPECT_EQ(segment.count(0, Kind::heard_again), 1u);
  EXPECT_EQ(segment.count(1, Kind::heard_again), 1u);
  EXPECT_EQ(segment.count(Kind::unheard), 1u) << "told once";
}

TEST(PresenceHearing, ReportsNobodyUnheardOnAGoodNetwork) {
  Segment segment(3, 0.01);
  for (std::uint16_t i = 1; i <= 8; ++i) segment.add(presence_of(i, 100u + i));
  segment.run(seconds(60));
  EXPECT_EQ(segment.count(Kind::unheard), 0u);
  EXPECT_EQ(segment.count(Kind::quiet), 0u);
  EXPECT_EQ(segment.count(Kind::slept), 0u);
}

// ------------------------------------------------------------------------------ lists in parts

PresenceConfig in_parts() {
  PresenceConfig config;
  config.most_listed = 4;
  config.part = 3;
  return config;
}

// Otherwise each of 244 to 256 peers would send two datagrams a second to all others.
TEST(PresenceParts, FitBesideAnnouncementAndTimeExchange) {
  const PresenceConfig config;
  const AggregatorConfig bundle;
  const std::size_t room = bundle.payload_limit - bundle.reserved - pdu::kDatagramTrailerSize;
  constexpr std::size_t kFixed = pdu::kFixedSize<pdu::Presence> +
                                 pdu::kFixedSize<pdu::TimeExchange> +
                                 pdu::kFixedSize<pdu::PeersHeard>;
  constexpr std::size_t kHeardEpoch = pdu::kFixedSize<pdu::PeerEpoch>;
  constexpr std::size_t kEcho = pdu::kFixedSize<pdu::TimeEcho>;
  EXPECT_LE(kFixed + 8 * kEcho + config.most_listed * kHeardEpoch, room);
  EXPECT_LE(kFixed + 24 * kEcho + config.part * kHeardEpoch, room);
}

TEST(PresenceParts, CoverAllReceivedPeersInOrder) {
  Presence presence(in_parts(), presence_of(1, 11));
  presence.start(seconds(1));
  std::set<std::uint32_t> told;
  std::uint32_t last = 0;
  bool ended = false;
  for (std::uint16_t i = 0; i < 8; ++i) {
    presence.receive(presence_of(static_cast<std::uint16_t>(20 + i), 100u + 5 * i % 8), seconds(1),
                     source(static_cast<std::uint8_t>(2 + i)));
  }
  for (int ms = 0; ms < 6000 && !ended; ++ms) {
    const nanoseconds now = seconds(1) + milliseconds(ms);
    for (std::uint32_t i = 0; i < 8; ++i) presence.note_alive(100 + i, now);
    (void)presence.step(now);
    const auto list = presence.take_list(now);
    if (!list) continue;
    EXPECT_LE(list->epochs.size(), 3u);
    EXPECT_TRUE(std::is_sorted(list->epochs.begin(), list->epochs.end()));
    EXPECT_EQ((list->continues & pdu::kPeersHeardBelow) != 0, !told.empty());
    if (!told.empty()) {
      EXPECT_EQ(list->epochs.front(), last);
    }
    last = list->epochs.back();
    told.insert(list->epochs.begin(), list->epochs.end());
    ended = (list->continues & pdu::kPeersHeardAbove) == 0;
  }
  EXPECT_TRUE(ended);
  EXPECT_EQ(told.size(), 8u);
}

TEST(PresenceParts, MakeNoStatementBeyondTheirRange) {
  Presence presence({}, presence_of(1, 500));
  presence.start(seconds(1));
  presence.receive(presence_of(2, 22), seconds(1), source(2));
  const auto hears = [&](std::uint32_t low, std::uint32_t high, std::uint16_t continues, int s) {
    const Octets epochs = record_octets(pdu::PeerEpoch{low}) + record_octets(pdu::PeerEpoch{high});
    pdu::PeersHeard list;
    list.epoch = 22;
    list.continues = continues;
    list.epochs = epochs;
    presence.note_alive(22, seconds(s));
    presence.receive(list, seconds(s), source(2));
    (void)presence.step(seconds(s));
    return kinds(presence);
  };
  const std::uint16_t both = pdu::kPeersHeardBelow | pdu::kPeersHeardAbove;
  EXPECT_EQ(hears(500, 600, both, 2), (std::vector<Kind>{Kind::newcomer, Kind::settled}));
  for (int s = 3; s <= 5; ++s) {
    EXPECT_TRUE(hears(100, 499, both, s).empty());
    EXPECT_TRUE(hears(501, 700, both, s).empty());
    EXPECT_TRUE(hears(1, 499, pdu::kPeersHeardAbove, s).empty());
    EXPECT_TRUE(hears(501, 999, pdu::kPeersHeardBelow, s).empty());
  }
  EXPECT_EQ(hears(499, 501, both, 6), std::vector<Kind>{Kind::unheard});
  EXPECT_TRUE(hears(501, 502, both, 6).empty());
  EXPECT_EQ(hears(1, 500, pdu::kPeersHeardAbove, 6), std::vector<Kind>{Kind::heard_again});
}

TEST(PresenceParts, ReportNobodyUnheardOnAGoodNetwork) {
  Segment segment(3, 0.01, in_parts());
  for (std::uint16_t i = 1; i <= 12; ++i) segment.add(presence_of(i, 100u + i));
  segment.run(seconds(60));
  EXPECT_EQ(segment.count(Kind::unheard), 0u);
  EXPECT_EQ(segment.count(Kind::quiet), 0u);
  EXPECT_TRUE(segment.agree());
}

TEST(PresenceParts, ReportAOneWayCutOneRoundLater) {
  Segment segment(2, 0.0, in_parts());
  for (std::uint16_t i = 1; i <= 7; ++i) segment.add(presence_of(i, 100u + i));
  segment.run(seconds(10));
  segment.cut([](std::size_t from, std::size_t to) { return from == 0 && to == 1; });
  segment.run(seconds(3 + 2));  // six received peers take three parts
  EXPECT_EQ(segment.count(0, Kind::unheard), 1u);
  EXPECT_EQ(segment.count(1, Kind::quiet), 1u);
  segment.cut({});
  segment.run(seconds(3 + 2));
  EXPECT_EQ(segment.count(0, Kind::heard_again), 1u);
  EXPECT_EQ(segment.count(1, Kind::heard_again), 1u);
  EXPECT_EQ(segment.count(Kind::unheard), 1u);
}

// Halves that meet under the same ids; each id has a peer in either half.
TEST(PresenceParts, MeetingHalvesAgreeOnOwnersOfIds) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(seed);
    Segment segment(seed, 0.0, in_parts());
    constexpr std::size_t kHalf = 7;
    segment.cut([](std::size_t a, std::size_t b) { return (a < kHalf) != (b < kHalf); });
    for (std::uint16_t i = 0; i < 2 * kHalf; ++i)
      segment.add(presence_of(static_cast<std::uint16_t>(1 + i % kHalf), 100u + i, 100u + i));
    segment.run(seconds(10));
    segment.cut({});
    segment.run(seconds(14));
    EXPECT_TRUE(segment.agree());
    EXPECT_EQ(segment.count(Kind::identity_changed), kHalf);
    segment.run(seconds(20));
    EXPECT_EQ(segment.count(Kind::identity_changed), kHalf) << "nobody moves any more";
  }
}

}  // namespace
}  // namespace reckon::aoim
