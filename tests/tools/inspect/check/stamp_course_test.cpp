// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Timestamps that stay constant, count in another unit or have a constant error: each fault gets
// its own rule, once, and correct timestamps get none.
#include "reckon/tools/inspect/check/stamp_course.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "reckon/pdu/seconds.hpp"
#include "reckon/pdu/timestamp.hpp"

namespace reckon::tools {
namespace {

using pdu::from_seconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;

constexpr nanoseconds kBegin = seconds(1'700'000'000);

struct Told {
  std::vector<std::string> rules;
  std::string reason;  // of the last finding
};

/// The findings for `count` updates, `interval` [s] apart, with timestamps `stamp(t)`.
Told told_of(
    int count, double interval, const std::function<std::uint32_t(double)>& stamp,
    const std::function<double(double)>& arrival = [](double t) { return t; }) {
  StampCourse course;
  Told told;
  const auto add = [&](const std::optional<StampCourse::Finding>& found) {
    if (!found.has_value()) return;
    told.rules.emplace_back(found->rule);
    told.reason = found->reason;
  };
  for (int i = 0; i < count; ++i) {
    const double t = i * interval;
    add(course.take(stamp(t), kBegin + from_seconds(arrival(t))));
  }
  add(course.finish());
  return told;
}

/// A correct timestamp.
std::uint32_t relative(double t) { return pdu::to_dis_timestamp(from_seconds(t), false); }
std::uint32_t absolute(double t) { return pdu::to_dis_timestamp(kBegin + from_seconds(t), true); }

using ToldRules = std::vector<std::string>;
const ToldRules kNothing;

TEST(StampCourse, ReportsNothingForCorrectTimestamps) {
  for (const double interval : {0.03, 0.7, 1.0, 5.0, 60.0}) {
    EXPECT_EQ(told_of(200, interval, relative).rules, kNothing) << interval;
    EXPECT_EQ(told_of(200, interval, absolute).rules, kNothing) << interval;
    // From 50 min past the hour on, across its end.
    EXPECT_EQ(told_of(200, interval, [](double t) { return relative(3000 + t); }).rules, kNothing);
  }
}

TEST(StampCourse, BearsJitterAndBurstsOfArrivals) {
  int number = 0;
  const auto jitter = [&](double t) { return t + 0.15 * (number++ % 3); };
  EXPECT_EQ(told_of(100, 0.5, absolute, jitter).rules, kNothing);
  // Held for 3 s of every 6, then released at once.
  const auto held = [](double t) {
    const double phase = std::fmod(t, 6.0);
    return phase < 3 ? t - phase + 3 : t;
  };
  EXPECT_EQ(told_of(300, 0.2, relative, held).rules, kNothing);
}

TEST(StampCourse, ReportsAConstantTimestamp) {
  const Told told = told_of(12, 1, [](double) { return 0U; });
  EXPECT_EQ(told.rules, ToldRules({"W-TIMESTAMP-STILL"}));
  EXPECT_EQ(told.reason, "the timestamp stays 0x00000000 while 4.000 s pass");
  EXPECT_EQ(told_of(2, 60, [](double) { return 77U; }).rules, ToldRules({"W-TIMESTAMP-STILL"}))
      << "at the end of a short capture";
  EXPECT_EQ(told_of(3, 1, [](double) { return 0U; }).rules, kNothing) << "nothing is off yet";
}

TEST(StampCourse, ReportsOtherUnits) {
  const auto counts = [](double per_second, double from) {
    return [=](double t) { return static_cast<std::uint32_t>(from + per_second * t); };
  };
  const Told thousandths = told_of(12, 1, counts(1e3, 0));
  EXPECT_EQ(thousandths.rules, ToldRules({"W-TIMESTAMP-PACE"}));
  EXPECT_THAT(thousandths.reason, HasSubstr("advance 0.00168 s while 2 s pass"));
  EXPECT_THAT(thousandths.reason, HasSubstr("they count milliseconds?"));
  const Told epoch = told_of(12, 1, counts(1, 1.7e9));
  EXPECT_EQ(epoch.rules, ToldRules({"W-TIMESTAMP-PACE"}));
  EXPECT_THAT(epoch.reason, HasSubstr("seconds since 1970"));
  EXPECT_THAT(told_of(40, 0.5, counts(1e6, 0)).reason, HasSubstr("microseconds"));
  EXPECT_THAT(told_of(40, 0.5, counts(0x1p31 / 3600, 0)).reason, HasSubstr("not shifted"));
}

TEST(StampCourse, ReportsAReplayByItsPace) {
  const auto faster = [](double t) { return t / 4; };
  const Told told = told_of(60, 1, absolute, faster);
  EXPECT_EQ(told.rules, ToldRules({"W-TIMESTAMP-PACE"}));
  EXPECT_THAT(told.reason, HasSubstr("advance 8 s while 2 s pass"));
}

TEST(StampCourse, ReportsAnErrorOnceThePaceIsRight) {
  const auto ahead = [](double t) { return absolute(t + 60); };
  const Told told = told_of(10, 1, ahead);
  EXPECT_EQ(told.rules, ToldRules({"W-TIMESTAMP-TOLERANCE"}));
  EXPECT_EQ(told.reason, "absolute timestamp is 60.000 s ahead of the arrival; 5 s are allowed");
  EXPECT_EQ(told_of(1, 1, ahead).rules, ToldRules({"W-TIMESTAMP-TOLERANCE"})) << "one update alone";
  // A clock that runs 1.5 times too fast is a drifting one.
  EXPECT_EQ(told_of(30, 1, [](double t) { return relative(1.5 * t); }).rules,
            ToldRules({"W-TIMESTAMP-TOLERANCE"}));
}

TEST(StampCourse, TakesAPauseForNoOtherPace) {
  const auto paused = [](double t) { return relative(t < 20 ? t : std::max(20.0, t - 10)); };
  EXPECT_EQ(
      told_of(
          60, 1, [](double t) { return relative(t < 20 ? t : t - 10); }, [](double t) { return t; })
          .rules,
      ToldRules({"W-TIMESTAMP-TOLERANCE"}));
  EXPECT_EQ(told_of(60, 1, paused).rules, ToldRules({"W-TIMESTAMP-STILL", "W-TIMESTAMP-TOLERANCE"}))
      << "updates went on while its clock stood";
}

TEST(StampCourse, RestartsWhereTheCaptureGoesBack) {
  const auto twice = [](double t) { return std::fmod(t, 30.0); };
  EXPECT_EQ(told_of(
                60, 1, [&](double t) { return relative(twice(t)); }, twice)
                .rules,
            kNothing);
  StampCourse timeless;
  for (int i = 0; i < 20; ++i) EXPECT_FALSE(timeless.take(0, nanoseconds::zero()).has_value());
  EXPECT_FALSE(timeless.finish().has_value());
}

}  // namespace
}  // namespace reckon::tools
