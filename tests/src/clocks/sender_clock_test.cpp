// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/clocks/sender_clock.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "reckon/pdu/timestamp.hpp"
#include "reckon/tests/src/support/heard_clock.hpp"

namespace reckon::peer {
namespace {

using namespace heard;

TEST(SenderClock, TakesAnAbsoluteTimestampAtItsWord) {
  Local local;
  for (int i = 0; i < 100; ++i, local.elapsed += milliseconds(37)) {
    const nanoseconds transit = milliseconds(i % 40);
    const std::uint32_t stamp = pdu::to_dis_timestamp(local.utc() - transit, true);
    expect_close(local.hear(stamp), local.now() - transit, kUnit);
  }
}

TEST(SenderClock, NeverPutsAStateIntoTheFuture) {
  Local local;
  for (const auto ahead : {milliseconds(1), milliseconds(500), milliseconds(990)}) {
    const std::uint32_t stamp = pdu::to_dis_timestamp(local.utc() + ahead, true);
    expect_close(local.hear(stamp), local.now(), nanoseconds(0));
  }
}

TEST(SenderClock, CarriesAbsoluteTimeAcrossTheHour) {
  Local local;
  local.elapsed = minutes(48) - milliseconds(5);  // 5 ms before the hour
  for (int i = 0; i < 10; ++i, local.elapsed += milliseconds(1)) {
    const std::uint32_t stamp = pdu::to_dis_timestamp(local.utc() - milliseconds(7), true);
    expect_close(local.hear(stamp), local.now() - milliseconds(7), kUnit);
  }
}

TEST(SenderClock, RefusesStraysAndGoesOn) {
  Local local;
  const auto hear = [&](nanoseconds age) {
    return local.hear(pdu::to_dis_timestamp(local.utc() - age, true));
  };
  ASSERT_TRUE(hear(nanoseconds(0)));
  for (const nanoseconds age :
       {nanoseconds(milliseconds(1600)), nanoseconds(minutes(20)), nanoseconds(seconds(10))}) {
    local.elapsed += milliseconds(500);
    EXPECT_FALSE(hear(age)) << "of the past";
    EXPECT_FALSE(hear(-age)) << "of the future";
    local.elapsed += milliseconds(10);
    expect_close(hear(milliseconds(5)), local.now() - milliseconds(5), kUnit);
    EXPECT_FALSE(local.clock.has_leapt());
  }
}

// A recorded exercise that is replayed faster, with silences in it.
TEST(SenderClock, FollowsAReplayAtAnySpeed) {
  for (const int speed : {2, 4, 10, 100}) {
    Local local;
    nanoseconds sent = minutes(20);
    ASSERT_TRUE(local.hear(pdu::to_dis_timestamp(sent, false)));
    local.elapsed += milliseconds(4000) / speed;
    sent += milliseconds(4000);
    int refused = 0;
    std::optional<nanoseconds> last;
    for (int i = 0; i < 1000; ++i) {
      const auto mapped = local.hear(pdu::to_dis_timestamp(sent, false));
      refused += mapped ? 0 : 1;
      if (mapped) {
        EXPECT_LE(*mapped, local.now());
        EXPECT_GE(*mapped, local.now() - milliseconds(100)) << speed << ' ' << i;
      }
      if (mapped && last) {
        EXPECT_GE(*mapped, *last);
      }
      if (mapped) last = mapped;
      const nanoseconds gap = i % 100 == 99 ? milliseconds(5000) : milliseconds(70);
      local.elapsed += gap / speed;
      sent += gap;
    }
    EXPECT_LE(refused, 1) << speed;
  }
}

TEST(SenderClock, RefusesStatesOlderThanTheLast) {
  Local local;
  const std::uint32_t stamp = pdu::to_dis_timestamp(minutes(7), false);
  ASSERT_TRUE(local.hear(stamp));
  local.elapsed += milliseconds(20);
  EXPECT_FALSE(local.hear(pdu::to_dis_timestamp(minutes(7) - milliseconds(1), false)));
  EXPECT_TRUE(local.hear(pdu::to_dis_timestamp(minutes(7) + milliseconds(1), false)));
}

TEST(SenderClock, UsesArrivalTimesWhileTheSenderClockStops) {
  Local local;
  const std::uint32_t stamp = pdu::to_dis_timestamp(minutes(7), false);
  ASSERT_TRUE(local.hear(stamp));
  for (int i = 0; i < 1000; ++i) {
    local.elapsed += milliseconds(20 + 100 * (i % 50));
    expect_close(local.hear(stamp), local.now(), nanoseconds(0));
    EXPECT_FALSE(local.clock.has_leapt());
  }
}

// Copies of one old packet are no evidence of a running clock.
TEST(SenderClock, CopiesOfOldStatesDoNotMoveIt) {
  for (const auto gap : {milliseconds(5), milliseconds(90), milliseconds(260), milliseconds(900)}) {
    Local local;
    const auto stamp = [&](nanoseconds back) {
      return pdu::to_dis_timestamp(minutes(7) + local.elapsed - back, false);
    };
    const std::uint32_t old = stamp(nanoseconds(0));
    ASSERT_TRUE(local.hear(old));
    local.elapsed += seconds(5);
    ASSERT_TRUE(local.hear(stamp(nanoseconds(0))));
    for (int i = 0; i < 200; ++i) {
      local.elapsed += gap;
      EXPECT_FALSE(local.hear(old)) << gap.count() << ' ' << i;
    }
    EXPECT_TRUE(local.hear(stamp(nanoseconds(0))));
    EXPECT_FALSE(local.clock.has_leapt());
  }
}

// A host declares absolute time, but its clock is off. Its time would be extrapolated 0.8 s too
// far, or be cut to the present.
TEST(SenderClock, RejectsAnImplausibleAbsoluteClock) {
  for (const auto wrong : {milliseconds(800), milliseconds(-800)}) {
    Local local;
    for (int i = 0; i < 500; ++i, local.elapsed += milliseconds(20)) {
      const nanoseconds transit = milliseconds(2 + i * 7 % 5);
      const auto mapped = local.hear(pdu::to_dis_timestamp(local.utc() - transit + wrong, true));
      expect_close(mapped, local.now() - transit + milliseconds(2),
                   i > 5 ? 2 * kUnit : milliseconds(5));
    }
  }
}

TEST(SenderClock, BelievesNoAbsoluteClockWhileOursIsNot) {
  Local local;
  for (int i = 0; i < 100; ++i, local.elapsed += milliseconds(20)) {
    const std::uint32_t stamp = pdu::to_dis_timestamp(local.utc() - milliseconds(200), true);
    expect_close(local.clock.local_time(stamp, local.now(), local.utc(), {false, {}}), local.now(),
                 kUnit);
  }
}

TEST(SenderClock, UsesTheMeasuredDifference) {
  for (const bool absolute : {true, false}) {
    Local local;
    for (int i = 0; i < 1000; ++i, local.elapsed += milliseconds(20)) {
      const nanoseconds transit = milliseconds(400 + i * 7 % 5);
      const nanoseconds ahead = minutes(20);
      const std::uint32_t stamp = pdu::to_dis_timestamp(local.utc() + ahead - transit, absolute);
      expect_close(local.clock.local_time(stamp, local.now(), local.utc(), {true, ahead}),
                   local.now() - transit, kUnit);
    }
  }
}

// When the estimate changes, the mapped time moves by a tenth of the elapsed time at most, and by 3
// ms/s for a change of 8 ms or less.
TEST(SenderClock, TakesUpAChangeOfTheEstimateSlowly) {
  const auto largest_rate = [](nanoseconds change) {
    Local local;
    double largest = 0.0;
    std::optional<nanoseconds> last;
    for (int i = 0; i < 3000; ++i, local.elapsed += milliseconds(10)) {
      const nanoseconds ahead = i < 500 ? nanoseconds(0) : change;
      const std::uint32_t stamp = pdu::to_dis_timestamp(local.utc() - milliseconds(100), false);
      const auto mapped = local.clock.local_time(stamp, local.now(), local.utc(), {true, ahead});
      const nanoseconds expected = local.now() - milliseconds(100) - ahead;
      if (i < 500) expect_close(mapped, expected, kUnit);
      if (i > 2990) expect_close(mapped, expected, microseconds(10));
      if (last) {
        const double moved = static_cast<double>((*mapped - *last).count()) - 10e6;
        largest = std::max(largest, std::abs(moved) / 10e6);
      }
      last = mapped;
    }
    return largest;
  };
  EXPECT_LT(largest_rate(milliseconds(8)), 3.2e-3);
  EXPECT_LT(largest_rate(milliseconds(-8)), 3.2e-3);
  EXPECT_LT(largest_rate(milliseconds(900)), 0.1003);
  EXPECT_LT(largest_rate(milliseconds(-90)), 0.0303);
}

// A sender of relative time: its clock starts anywhere; transit is a constant plus jitter.
void expect_relative(nanoseconds origin, bool says_absolute) {
  Local local;
  for (int i = 0; i < 2000; ++i, local.elapsed += milliseconds(10)) {
    const nanoseconds jitter = microseconds((i * 7919) % 3000);
    const nanoseconds sent = local.elapsed - milliseconds(20) - jitter;
    const auto mapped = local.hear(pdu::to_dis_timestamp(origin + sent, says_absolute));
    // The constant 20 ms are taken as zero; the jitter is removed once the minimum has been seen.
    if (i > 200) expect_close(mapped, local.now() - jitter, microseconds(40));
  }
}

TEST(SenderClock, MapsRelativeTimeThroughTheSmallestTransit) { expect_relative(minutes(3), false); }

TEST(SenderClock, CarriesRelativeTimeAcrossTheHour) {
  expect_relative(hours(1) - seconds(10), false);
}

TEST(SenderClock, TreatsAnUnsynchronisedAbsoluteClockAsRelative) {
  expect_relative(kUtc + minutes(20), true);
}

TEST(SenderClock, FollowsADriftingSender) {
  Local local;
  for (int i = 0; i < 60'000; ++i, local.elapsed += milliseconds(10)) {
    // 100 ppm slow: after 600 s it is 60 ms behind its start.
    const nanoseconds sent(std::llround(0.9999 * static_cast<double>(local.elapsed.count())));
    const auto mapped = local.hear(pdu::to_dis_timestamp(minutes(1) + sent, false));
    // The drift of at most 20 s is not yet compensated.
    expect_close(mapped, local.now(), milliseconds(3));
  }
}

TEST(SenderClock, TimesNeverFallWhenTheTransitBecomesKnown) {
  Local local;
  std::optional<nanoseconds> last;
  for (int i = 0; i < 100; ++i, local.elapsed += milliseconds(10)) {
    const std::uint32_t stamp = pdu::to_dis_timestamp(local.utc() - milliseconds(100), false);
    const auto ahead = i < 20 ? std::optional<nanoseconds>() : nanoseconds(0);
    const auto mapped = local.clock.local_time(stamp, local.now(), local.utc(), {true, ahead});
    ASSERT_TRUE(mapped);
    if (last) {
      EXPECT_GE(*mapped, *last);
    }
    last = mapped;
  }
  expect_close(last, local.now() - milliseconds(110), kUnit);
}

TEST(SenderClock, MeasuresTheDriftOfASender) {
  for (const double drift : {100e-6, -200e-6, 0.0}) {
    Local local;
    for (int i = 0; i < 6000; ++i, local.elapsed += milliseconds(20)) {
      const nanoseconds jitter = microseconds((i * 7919) % 3000);
      const nanoseconds sent(
          std::llround((1.0 - drift) * static_cast<double>((local.elapsed - jitter).count())));
      (void)local.hear(pdu::to_dis_timestamp(minutes(1) + sent, false));
    }
    EXPECT_NEAR(local.clock.drift(), drift, 5e-6);
  }
}

TEST(SenderClock, GivesEarlierTimesToOlderStates) {
  Local local;
  std::optional<nanoseconds> last;
  for (int i = 0; i < 500; ++i, local.elapsed += milliseconds(20)) {
    const auto mapped = local.hear(pdu::to_dis_timestamp(minutes(5) + local.elapsed, false));
    ASSERT_TRUE(mapped.has_value());
    if (last) {
      EXPECT_GT(*mapped, *last);
    }
    last = mapped;
  }
}

}  // namespace
}  // namespace reckon::peer
