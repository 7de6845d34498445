// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/clocks/peer_clock.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "reckon/pdu/timestamp.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::peer::peer_clock_test {
namespace {

using std::chrono::hours;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::minutes;
using std::chrono::nanoseconds;
using std::chrono::seconds;

constexpr nanoseconds kUtc = hours(500'000);
constexpr std::uint32_t kUs = 7, kThem = 8;

nanoseconds scaled(nanoseconds time, double factor) {
  return nanoseconds(std::llround(factor * static_cast<double>(time.count())));
}

// This peer and one other peer. Each sends one datagram a second, with an echo of the latest
// datagram of the other.
struct Pair {
  PeerClocks ours, theirs;
  nanoseconds now = seconds(100);  // our steady time; our UTC is kUtc + now
  nanoseconds ahead{0};            // theirs minus ours
  double drift = 0.0;
  bool aligned = true;  // whether both declare their clocks aligned to UTC
  nanoseconds to_them = milliseconds(1), to_us = milliseconds(1);
  nanoseconds jitter{0};
  double loss = 0.0;
  std::mt19937 random{1};

  [[nodiscard]] nanoseconds our_utc(nanoseconds at) const { return kUtc + at; }
  [[nodiscard]] nanoseconds their_utc(nanoseconds at) const { return kUtc + at + ahead_at(at); }
  [[nodiscard]] nanoseconds ahead_at(nanoseconds at) const { return ahead + scaled(at, drift); }

  static void send(PeerClocks& from, std::uint32_t from_epoch, nanoseconds sent_utc,
                   nanoseconds sent, PeerClocks& to, std::uint32_t to_epoch, nanoseconds heard_utc,
                   nanoseconds heard, bool says_utc, bool is_lost) {
    pdu::TimeExchange exchange;
    exchange.epoch = from_epoch;
    const bool any = from.fill(exchange, sent);
    if (is_lost) return;
    pdu::DatagramTrailer trailer;
    trailer.epoch = from_epoch;
    trailer.send_time = pdu::trailer_time(sent_utc);
    trailer.header.timestamp = pdu::to_dis_timestamp(sent_utc, says_utc);
    to.receive(trailer, heard_utc, heard);
    if (any) to.take(exchange, to_epoch, trailer, heard_utc, heard);
  }
  nanoseconds way(nanoseconds least) {
    std::uniform_real_distribution<double> share(0.0, 1.0);
    return least + scaled(jitter, share(random));
  }
  void run(int count) {
    std::bernoulli_distribution lost(loss);
    for (int i = 0; i < count; ++i) {
      now += seconds(1);
      const nanoseconds there = now + way(to_them);
      send(ours, kUs, our_utc(now), now, theirs, kThem, their_utc(there), there, true,
           lost(random));
      const nanoseconds sent = now + milliseconds(400), back = sent + way(to_us);
      send(theirs, kThem, their_utc(sent), sent, ours, kUs, our_utc(back), back, aligned,
           lost(random));
    }
  }
  [[nodiscard]] std::optional<ClockDifference> found() const {
    return ours.difference(kThem, now + seconds(1));
  }
  [[nodiscard]] nanoseconds error() const {
    const auto known = found();
    return known ? known->ahead - ahead_at(now + seconds(1)) : nanoseconds::max();
  }
};

TEST(PeerClock, KnowsNothingBeforeTheFirstEcho) {
  Pair pair;
  EXPECT_FALSE(pair.found());
  EXPECT_FALSE(pair.ours.ahead(kThem, true, pair.now));
  pair.run(1);
  EXPECT_TRUE(pair.found()) << "their first datagram has answered ours already";
}

TEST(PeerClock, FindsTheDifferenceExactlyWithEqualDelays) {
  for (const nanoseconds ahead : {nanoseconds(milliseconds(800)), nanoseconds(-milliseconds(800)),
                                  nanoseconds(minutes(34)), nanoseconds(-minutes(34))}) {
    Pair pair;
    pair.ahead = ahead;
    pair.run(2);
    ASSERT_TRUE(pair.found());
    EXPECT_LE(std::chrono::abs(pair.error()), microseconds(2)) << ahead.count();
    EXPECT_NEAR(static_cast<double>(pair.found()->round_trip.count()), 2e6, 4e3);
  }
}

// A longer delay in one direction cannot be distinguished from a clock that is ahead.
TEST(PeerClock, ErrsByHalfTheDifferenceOfTheWays) {
  Pair pair;
  pair.ahead = milliseconds(50);
  pair.to_them = milliseconds(9);
  pair.to_us = milliseconds(1);
  pair.run(5);
  EXPECT_NEAR(static_cast<double>(pair.error().count()), 4e6, 4e3);
  EXPECT_LE(std::chrono::abs(pair.error()), pair.found()->round_trip / 2);
}

TEST(PeerClock, TakesTheQuickestPacketEachWay) {
  Pair pair;
  pair.ahead = milliseconds(300);
  pair.to_them = pair.to_us = milliseconds(20);
  pair.jitter = milliseconds(10);
  double sum = 0.0;
  for (int i = 0; i < 100; ++i) {
    pair.run(10);
    const double error = static_cast<double>(pair.error().count());
    sum += error * error;
  }
  // A single exchange errs by 10 ms / sqrt(24) = 2.0 ms; the minimum of 10 to 20 each way errs by
  // 0.5 ms.
  EXPECT_LT(std::sqrt(sum / 100), 0.9e6);
}

TEST(PeerClock, MeasuresADrift) {
  for (const double drift : {50e-6, -200e-6}) {
    Pair pair;
    pair.ahead = milliseconds(-800);
    pair.drift = drift;
    pair.run(20);
    EXPECT_LE(std::chrono::abs(pair.error()), scaled(seconds(20), std::abs(drift)));
    pair.run(100);
    for (int i = 0; i < 100; ++i) {
      pair.run(1);
      EXPECT_LE(std::chrono::abs(pair.error()), microseconds(20)) << i;
    }
    EXPECT_NEAR(pair.found()->drift, drift, 2e-6);
  }
}

TEST(PeerClock, ErrsByAtMostHalfTheRoundTrip) {
  for (std::uint32_t seed = 1; seed <= 100; ++seed) {
    SCOPED_TRACE(seed);
    Pair pair;
    pair.random.seed(seed);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    pair.ahead = scaled(minutes(30), any(pair.random));
    pair.drift = 200e-6 * any(pair.random);
    pair.to_them = scaled(milliseconds(100), std::abs(any(pair.random)));
    pair.to_us = scaled(milliseconds(100), std::abs(any(pair.random)));
    pair.jitter = scaled(milliseconds(40), std::abs(any(pair.random)));
    pair.loss = 0.3;
    pair.run(20);
    for (int i = 0; i < 200; ++i) {
      pair.run(1);
      if (!pair.found()) continue;
      // Half the jitter (if no fast packet arrived in one direction) plus 20 s of drift.
      const nanoseconds bound = (pair.to_them + pair.to_us + pair.jitter) / 2 + milliseconds(5);
      EXPECT_LE(std::chrono::abs(pair.error()), bound);
    }
  }
}

TEST(PeerClock, TrustsTwoUtcClocksUnlessDelaysContradict) {
  Pair pair;
  pair.to_them = milliseconds(30);
  pair.to_us = milliseconds(12);
  pair.run(3);
  EXPECT_EQ(pair.ours.ahead(kThem, true, pair.now), nanoseconds(0)) << "2.5 : 1 is a usual path";
  EXPECT_GT(pair.ours.ahead(kThem, false, pair.now), milliseconds(8)) << "ours is not UTC";

  pair.aligned = false;
  pair.run(1);
  EXPECT_GT(pair.ours.ahead(kThem, true, pair.now), milliseconds(8)) << "theirs is not UTC";

  Pair apart;
  apart.ahead = milliseconds(5);
  apart.run(3);
  EXPECT_NEAR(static_cast<double>(apart.ours.ahead(kThem, true, apart.now)->count()), 5e6, 4e3)
      << "1 ms each way: 5 ms are no asymmetry";
}

// 71.6 minutes of microseconds.
TEST(PeerClock, CarriesOnWhereTheCountOfMicrosecondsWraps) {
  Pair pair;
  pair.ahead = milliseconds(800);
  const auto wrap = microseconds(std::uint64_t{1} << 32);
  pair.now = wrap * ((kUtc + seconds(100)) / wrap + 1) - kUtc - seconds(10);
  pair.run(1);
  for (int i = 0; i < 20; ++i) {
    pair.run(1);
    EXPECT_LE(std::chrono::abs(pair.error()), microseconds(2)) << i;
  }
  EXPECT_EQ(pair.ours.refused(), 0u);
}

TEST(PeerClock, LearnsAClockAgainAfterALeap) {
  for (const nanoseconds leap : {seconds(10), -seconds(10)}) {
    Pair pair;
    pair.ahead = milliseconds(20);
    pair.run(30);
    pair.ahead += leap;
    pair.run(6);
    EXPECT_LE(std::chrono::abs(pair.error()), microseconds(2));
    pair.ahead -= leap;
    pair.run(6);
    EXPECT_LE(std::chrono::abs(pair.error()), microseconds(2));
  }
}

TEST(PeerClock, HeedsNoSingleDatagramWithAnImpossibleTime) {
  Pair pair;
  pair.run(10);
  for (const nanoseconds stray : {seconds(10), -seconds(10)}) {
    pdu::DatagramTrailer trailer;
    trailer.epoch = kThem;
    trailer.send_time = pdu::trailer_time(pair.our_utc(pair.now) + stray);
    pair.ours.receive(trailer, pair.our_utc(pair.now), pair.now);
    pair.run(1);
    EXPECT_LE(std::chrono::abs(pair.error()), microseconds(2));
  }
}

TEST(PeerClock, RefusesEchoesWithImpossibleTimes) {
  const nanoseconds utc = kUtc + seconds(50);
  const std::uint32_t at = pdu::trailer_time(utc);
  struct Case {
    pdu::TimeEcho echo;
    std::uint32_t answered;
    bool good;
  };
  const std::array<Case, 8> cases{{
      {{kUs, at - 2000, at - 1000}, at - 1000, true},
      {{kUs, at + 1, at}, at, false},                                // of a datagram not sent yet
      {{kUs, at - 31'000'000, at - 1000}, at, false},                // of one long ago
      {{kUs, at - 2000, at}, at - 1, false},                         // answered before received
      {{kUs, at - 2000, at - 31'000'000}, at, false},                // held too long
      {{kUs, at - 2'500'000, at}, at + 1, false},                    // 2.5 s on the way
      {{kUs, at - 2000, at - 500'000}, at, false},                   // held longer than it took
      {{kUs, at - 2000, at + 0x70000000U}, at + 0x70000000U, true},  // a clock 31 min off
  }};
  for (const Case& one : cases) {
    PeerClock clock;
    clock.receive(one.answered, utc, seconds(50));
    EXPECT_EQ(clock.take(one.echo, one.answered, utc, seconds(50)), one.good) << &one - &cases[0];
    EXPECT_EQ(clock.difference(seconds(50)).has_value(), one.good);
  }
}

TEST(PeerClock, ForgetsOldMeasurements) {
  Pair pair;
  pair.run(5);
  EXPECT_TRUE(pair.ours.difference(kThem, pair.now + seconds(59)));
  EXPECT_FALSE(pair.ours.difference(kThem, pair.now + seconds(62)));
}

TEST(PeerClocks, EchoEightPeersAtATimeInTurn) {
  PeerClocks clocks;
  pdu::DatagramTrailer trailer;
  for (std::uint32_t epoch = 1; epoch <= 20; ++epoch) {
    trailer.epoch = epoch;
    clocks.receive(trailer, kUtc, seconds(1));
  }
  std::array<int, 21> echoed{};
  for (int i = 0; i < 5; ++i) {
    pdu::TimeExchange exchange;
    ASSERT_TRUE(clocks.fill(exchange, seconds(2)));
    int count = 0;
    for (const auto& echo : pdu::records_of<pdu::TimeEcho>(exchange.echoes)) {
      ++echoed[echo.epoch];
      ++count;
    }
    EXPECT_EQ(count, 8);
  }
  for (std::size_t epoch = 1; epoch <= 20; ++epoch) EXPECT_EQ(echoed[epoch], 2) << epoch;
  pdu::TimeExchange exchange;
  EXPECT_FALSE(clocks.fill(exchange, seconds(7))) << "all are silent for more than 5 s";
}

// Datagrams with random times, with good exchanges between them. The published clock difference
// stays within the range of trailers, and impossible times are refused.
TEST(PeerClocks, KeepTheirBoundsUnderRandomTimes) {
  Pair pair;
  for (int i = 0; i < 20'000; ++i) {
    if (i % 100 == 0) pair.run(1);
    const auto any = [&] { return static_cast<std::uint32_t>(pair.random()); };
    const nanoseconds utc = pair.our_utc(pair.now);
    pdu::DatagramTrailer trailer;
    trailer.epoch = kThem;
    trailer.send_time = pdu::trailer_time(utc) + (i % 2 == 0 ? any() : any() % 10'000'000);
    trailer.header.timestamp = any();
    std::array<std::byte, 12> octets{};
    const pdu::TimeEcho echo{kUs, pdu::trailer_time(utc) - any() % 3'000'000,
                             trailer.send_time - any() % 3'000'000};
    ASSERT_EQ(pdu::store_record(echo, octets), octets.size());
    pdu::TimeExchange exchange;
    exchange.epoch = kThem;
    exchange.echoes = octets;
    pair.ours.receive(trailer, utc, pair.now);
    pair.ours.take(exchange, kUs, trailer, utc, pair.now);
    const auto known = pair.ours.difference(kThem, pair.now);
    if (!known) continue;
    EXPECT_LE(std::chrono::abs(known->ahead), minutes(36));
    EXPECT_LE(known->round_trip, PeerClock::kMostRoundTrip);
    EXPECT_LE(std::abs(known->drift), LeastTransit::kMostDrift);
  }
  EXPECT_GT(pair.ours.refused(), 1000u);
}

// A flood of forged epochs evicts the entries that were silent the longest; memory stays constant.
TEST(PeerClocks, StayBounded) {
  PeerClocks clocks;
  pdu::DatagramTrailer trailer;
  test::AllocationGuard guard;
  for (std::uint32_t i = 0; i < 10'000; ++i) {
    trailer.epoch = 1 + i;
    clocks.receive(trailer, kUtc, milliseconds(i));
    pdu::TimeExchange exchange;
    exchange.epoch = trailer.epoch;
    ASSERT_TRUE(clocks.fill(exchange, milliseconds(i)));
    clocks.take(exchange, kUs, trailer, kUtc, milliseconds(i));
    static_cast<void>(clocks.ahead(trailer.epoch, true, milliseconds(i)));
  }
  EXPECT_EQ(guard.count(), 0u);
}

}  // namespace
}  // namespace reckon::peer::peer_clock_test
