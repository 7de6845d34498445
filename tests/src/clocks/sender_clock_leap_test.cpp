// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A sender's clock that leaps, falls silent or lags: mapped times stay continuous and within
// bounds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <random>
#include <vector>

#include "reckon/pdu/timestamp.hpp"
#include "reckon/tests/src/support/heard_clock.hpp"

namespace reckon::peer {
namespace {

using namespace heard;

// The sender's clock leaps. Mapped times do not jump; updates are refused for half a second.
struct Leap {
  nanoseconds size;
  nanoseconds interval;  // between updates
  bool absolute;

  // GoogleTest would also print the padding octets between the members, which differ from run to
  // run.
  friend void PrintTo(const Leap& leap, std::ostream* out) {
    *out << leap.size.count() / 1'000'000 << "ms_each_" << leap.interval.count() / 1'000'000
         << "ms_" << (leap.absolute ? "absolute" : "relative");
  }
};
class SenderClockLeap : public testing::TestWithParam<Leap> {};

TEST_P(SenderClockLeap, KeepsTheTimesGivenContinuous) {
  const auto [size, interval, absolute] = GetParam();
  Local local;
  nanoseconds ahead = absolute ? nanoseconds(0) : minutes(17), silent_since{0}, silence{0};
  int leaps = 0;
  const auto updates = static_cast<int>(seconds(60) / interval);
  for (int i = 0; i < 3 * updates; ++i, local.elapsed += interval) {
    if (i == updates) ahead += size;      // forth
    if (i == 2 * updates) ahead -= size;  // and back
    const nanoseconds jitter = microseconds(i * 7919 % 8000);
    const nanoseconds sent = local.elapsed - milliseconds(20) - jitter;
    const auto mapped = local.hear(pdu::to_dis_timestamp(kUtc + sent + ahead, absolute));
    if (!mapped) {
      silence = std::max(silence, local.elapsed - silent_since);
      continue;
    }
    silent_since = local.elapsed;
    leaps += local.clock.has_leapt() ? 1 : 0;
    if (i < 10) continue;
    // Absolute time: exact before the leap. After it, and for relative time, the error is the delay
    // of the fastest of the few packets then available; a constant 20 ms that was known stays
    // known.
    const nanoseconds constant = absolute ? milliseconds(20) : milliseconds(0);
    expect_close(mapped, local.now() - constant - jitter, milliseconds(8));
  }
  EXPECT_EQ(leaps, 2);
  EXPECT_LE(silence, std::max<nanoseconds>(milliseconds(400), interval));
}

INSTANTIATE_TEST_SUITE_P(ForthAndBack, SenderClockLeap,
                         testing::Values(Leap{seconds(10), milliseconds(20), true},
                                         Leap{seconds(10), milliseconds(20), false},
                                         Leap{seconds(-10), milliseconds(100), true},
                                         Leap{seconds(-10), milliseconds(1), false},
                                         Leap{minutes(20), milliseconds(200), true},
                                         Leap{seconds(10), seconds(5), true},
                                         Leap{seconds(-10), seconds(5), false},
                                         Leap{seconds(2), milliseconds(20), true},
                                         Leap{milliseconds(-1500), milliseconds(20), false}));

// Datagrams queued during an outage of 3 s arrive within half a second: late, but the clock did not
// change.
TEST(SenderClock, TakesAQueueThatEmptiesForNoLeap) {
  Local local;
  for (int i = 0; i < 1000; ++i) {
    const nanoseconds sent = milliseconds(20) * i;
    const bool waits = sent >= seconds(10) && sent < seconds(13) + milliseconds(600);
    local.elapsed = waits ? seconds(13) + (sent - seconds(10)) / 6 : sent;
    const auto mapped = local.hear(pdu::to_dis_timestamp(kUtc + sent, true));
    EXPECT_FALSE(local.clock.has_leapt());
    if (local.now() - (seconds(100) + sent) < milliseconds(990)) {
      expect_close(mapped, seconds(100) + sent, 2 * kUnit);
    }
  }
}

TEST(SenderClock, SurvivesASilenceOfHours) {
  for (const nanoseconds silence : {nanoseconds(minutes(29)), nanoseconds(minutes(31)),
                                    nanoseconds(minutes(60)), nanoseconds(minutes(200))}) {
    Local local;
    for (int i = 0; i < 400; ++i, local.elapsed += i == 200 ? silence : milliseconds(20)) {
      // 50 ppm slow.
      const nanoseconds sent(std::llround(0.99995 * static_cast<double>(local.elapsed.count())));
      expect_close(local.hear(pdu::to_dis_timestamp(minutes(1) + sent, false)), local.now(),
                   milliseconds(1) + silence / 10'000);
      EXPECT_FALSE(local.clock.has_leapt());
    }
  }
}

// Mapped times are finite, never in the future and never fall, whatever arrives. While the sender's
// clock does not leap they are right within the jitter and 20 s of drift.
TEST(SenderClock, KeepsItsBoundsForAnyInput) {
  for (std::uint32_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(-1.0, 1.0), share(0.0, 1.0);
    const auto ns = [](double time) { return nanoseconds(std::llround(1e9 * time)); };
    const double rate = std::pow(10.0, -0.7 + 3.7 * share(random));  // 0.2 Hz to 1 kHz
    const double jitter = 0.1 * share(random), constant = 0.1 * share(random);
    const double drift = 200e-6 * any(random);
    double ahead = 3600.0 * 5 * any(random);
    const bool says_absolute = share(random) < 0.5;

    struct Packet {
      nanoseconds arrival, sent;
      std::uint32_t stamp;
    };
    std::vector<Packet> packets;
    const int count = static_cast<int>(std::min(20'000.0, 120.0 * rate));
    for (int i = 0; i < count; ++i) {
      const double sent = i / rate;
      if (i > 0 && i % std::max(count / 3, 1) == 0) ahead += 1500.0 * any(random);
      if (share(random) < 0.3) continue;
      const double transit = constant + jitter * share(random);
      const auto stamp =
          pdu::to_dis_timestamp(kUtc + ns(sent * (1.0 + drift) + ahead), says_absolute);
      packets.push_back({ns(sent + transit), ns(sent), stamp});
    }
    std::stable_sort(packets.begin(), packets.end(),
                     [](const Packet& a, const Packet& b) { return a.arrival < b.arrival; });

    Local local;
    nanoseconds last = nanoseconds::min();
    for (const Packet& packet : packets) {
      local.elapsed = packet.arrival;
      const auto mapped = local.hear(packet.stamp);
      if (!mapped) continue;
      EXPECT_LE(*mapped, local.now());
      EXPECT_GE(*mapped, last);
      last = *mapped;
      // An accepted absolute time is right; an unknown transit is taken as zero: 0 to 0.3 s late or
      // early.
      const nanoseconds early = local.now() - packet.arrival + packet.sent - *mapped;
      EXPECT_LE(early, ns(0.3 + jitter + 0.01)) << packet.sent.count();
      EXPECT_GE(early, -ns(constant + jitter + 0.01)) << packet.sent.count();
    }
  }
}

}  // namespace
}  // namespace reckon::peer
