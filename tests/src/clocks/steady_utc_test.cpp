// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/clocks/steady_utc.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace reckon::peer {
namespace {

using std::chrono::hours;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

// A host whose UTC drifts and is set; it is read every 2 ms.
struct Host {
  SteadyUtc steady_utc;
  nanoseconds now = seconds(5);
  nanoseconds utc = hours(500'000);
  double drift = 0.0;
  nanoseconds given{0};
  int leaps = 0;

  Host() { given = steady_utc.at(now, utc); }

  // Runs and checks that the result neither jumps nor runs at another rate than promised.
  void run(nanoseconds time, nanoseconds step = milliseconds(2)) {
    for (const nanoseconds end = now + time; now < end;) {
      now += step;
      utc += step + nanoseconds(std::llround(drift * static_cast<double>(step.count())));
      const nanoseconds next = steady_utc.at(now, utc);
      const double rate =
          static_cast<double>((next - given).count()) / static_cast<double>(step.count());
      ASSERT_NEAR(rate, 1.0, 500.001e-6);
      given = next;
      leaps += steady_utc.leap() ? 1 : 0;
    }
  }
  [[nodiscard]] nanoseconds behind() const { return utc - given; }
};

TEST(SteadyUtc, TakesTheHostAtItsWordAtFirst) {
  Host host;
  EXPECT_EQ(host.given, host.utc);
  EXPECT_TRUE(host.steady_utc.is_aligned());
}

TEST(SteadyUtc, FollowsAHostThatIsSlewedOrDrifts) {
  for (const double drift : {100e-6, -100e-6, 490e-6}) {
    Host host;
    host.drift = drift;
    host.run(hours(1), milliseconds(20));
    EXPECT_LT(std::chrono::abs(host.behind()), microseconds(10)) << drift;
    EXPECT_EQ(host.leaps, 0);
    EXPECT_TRUE(host.steady_utc.is_aligned());
  }
}

TEST(SteadyUtc, ContinuesWithoutAJumpWhenTheHostLeaps) {
  for (const nanoseconds leap : {nanoseconds(seconds(10)), nanoseconds(-seconds(10)),
                                 nanoseconds(hours(20)), nanoseconds(-hours(400'000))}) {
    Host host;
    host.run(seconds(2));
    host.utc += leap;
    host.run(seconds(10));
    EXPECT_EQ(host.leaps, 1);
    EXPECT_FALSE(host.steady_utc.is_aligned());
    // 500 ppm of the 9.5 s since the leap was reported.
    EXPECT_NEAR(
        static_cast<double>((std::chrono::abs(leap) - std::chrono::abs(host.behind())).count()),
        9.5 * 500e3, 2e3);
  }
}

TEST(SteadyUtc, ReportsALeapAfterHalfASecond) {
  Host host;
  host.utc += seconds(3);
  host.run(milliseconds(498));
  EXPECT_EQ(host.leaps, 0);
  host.run(milliseconds(6));
  EXPECT_EQ(host.leaps, 1);
}

TEST(SteadyUtc, IsAlignedAgainAfterSlewingOverALeap) {
  Host host;
  host.utc += seconds(1);
  host.run(seconds(1700), milliseconds(20));  // (1 s - 0.128 s) / 500e-6 = 1744 s
  EXPECT_FALSE(host.steady_utc.is_aligned());
  host.run(seconds(50), milliseconds(20));
  EXPECT_TRUE(host.steady_utc.is_aligned());
  host.run(seconds(300), milliseconds(20));
  EXPECT_EQ(host.behind(), nanoseconds(0));
}

TEST(SteadyUtc, IsAlignedAgainWhenTheHostLeapsBack) {
  Host host;
  host.utc += seconds(10);
  host.run(seconds(20));
  host.utc -= seconds(10);
  host.run(seconds(1));
  EXPECT_EQ(host.leaps, 2);
  EXPECT_TRUE(host.steady_utc.is_aligned());
  host.run(seconds(30));
  EXPECT_EQ(host.behind(), nanoseconds(0));
}

// The process was preempted between reading the two clocks.
TEST(SteadyUtc, TakesOneLateReadingForNoLeap) {
  Host host;
  for (int i = 0; i < 100; ++i) {
    host.utc += milliseconds(300);
    host.run(milliseconds(2));
    host.utc -= milliseconds(300);
    host.run(milliseconds(100));
  }
  EXPECT_EQ(host.leaps, 0);
  EXPECT_EQ(host.behind(), nanoseconds(0));
}

TEST(SteadyUtc, NeverJumpsForAnyHostClock) {
  for (std::uint32_t seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> exponent(-6.0, 4.0), any(-1.0, 1.0);
    Host host;
    for (int i = 0; i < 50; ++i) {
      host.drift = 1e-3 * any(random);
      const double leap = std::copysign(std::pow(10.0, exponent(random)), any(random));
      host.utc += nanoseconds(std::llround(1e9 * leap));
      host.run(seconds(2), milliseconds(1 + i));
    }
  }
}

}  // namespace
}  // namespace reckon::peer
