// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sender_clock.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "pdu/timestamp.hpp"

namespace reckon::peer {
namespace {

using std::chrono::hours;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::minutes;
using std::chrono::nanoseconds;
using std::chrono::seconds;

constexpr nanoseconds kUtc = hours(500'000) + minutes(12);  // some 57 years, 12 min past the hour
constexpr nanoseconds kUnit{1680};                          // one unit of a DIS timestamp

// Local steady time runs from 100 s while UTC runs from kUtc.
struct Local {
  SenderClock clock;
  nanoseconds elapsed{0};

  [[nodiscard]] nanoseconds now() const { return seconds(100) + elapsed; }
  [[nodiscard]] nanoseconds utc() const { return kUtc + elapsed; }
  std::optional<nanoseconds> hear(std::uint32_t timestamp) {
    return clock.local_time(timestamp, now(), utc());
  }
};

void expect_close(std::optional<nanoseconds> actual, nanoseconds expected, nanoseconds tolerance) {
  ASSERT_TRUE(actual.has_value());
  EXPECT_LE(std::abs((*actual - expected).count()), tolerance.count())
      << actual->count() << " against " << expected.count();
}

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
  for (const auto ahead : {milliseconds(1), milliseconds(500), milliseconds(4900)}) {
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

TEST(SenderClock, RefusesAStateOfASynchronisedSenderThatIsOutOfTolerance) {
  Local local;
  ASSERT_TRUE(local.hear(pdu::to_dis_timestamp(local.utc(), true)).has_value());
  for (const nanoseconds age : {nanoseconds(milliseconds(5100)), nanoseconds(minutes(20))}) {
    EXPECT_FALSE(local.hear(pdu::to_dis_timestamp(local.utc() - age, true)).has_value());
    EXPECT_FALSE(local.hear(pdu::to_dis_timestamp(local.utc() + age, true)).has_value());
  }
  EXPECT_TRUE(local.hear(pdu::to_dis_timestamp(local.utc() - seconds(4), true)).has_value());
}

// A sender of relative time: its own clock starts anywhere, transit is a constant part plus jitter.
void expect_relative(nanoseconds origin, bool says_absolute) {
  Local local;
  for (int i = 0; i < 2000; ++i, local.elapsed += milliseconds(10)) {
    const nanoseconds jitter = microseconds((i * 7919) % 3000);
    const nanoseconds sent = local.elapsed - milliseconds(20) - jitter;
    const auto mapped = local.hear(pdu::to_dis_timestamp(origin + sent, says_absolute));
    // The constant 20 ms are taken for zero; the jitter is taken out once the least has been seen.
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
    // 100 ppm slow: after 600 s it is 60 ms behind where it began.
    const nanoseconds sent(std::llround(0.9999 * static_cast<double>(local.elapsed.count())));
    const auto mapped = local.hear(pdu::to_dis_timestamp(minutes(1) + sent, false));
    // At most 20 s of drift are not taken up yet.
    expect_close(mapped, local.now(), milliseconds(3));
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
