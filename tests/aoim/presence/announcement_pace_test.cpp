// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/presence/announcement_pace.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "reckon/tests/aoim/support/segment.hpp"

namespace reckon::aoim {
namespace {

using namespace test;

// Times of announcements [ms after 2 s], until `until_ms`, if nobody lists us.
std::vector<std::int64_t> left_by(AnnouncementPace& pace, std::int64_t from_ms,
                                  std::int64_t until_ms, bool acquainted = false) {
  std::vector<std::int64_t> left;
  for (std::int64_t ms = from_ms; ms <= until_ms; ++ms) {
    const nanoseconds now = seconds(2) + milliseconds(ms);
    if (!pace.is_due(now)) continue;
    pace.note_announced(now, acquainted);
    left.push_back(ms);
  }
  return left;
}

TEST(AnnouncementPace, IsNeverDueBeforeStartNorAfterStop) {
  const PresenceConfig config;
  AnnouncementPace pace(config);
  pace.announce_soon(seconds(1));
  EXPECT_FALSE(pace.is_due(seconds(100)));
  pace.start(seconds(2));
  EXPECT_TRUE(pace.is_due(seconds(2)));
  pace.stop();
  EXPECT_FALSE(pace.is_due(seconds(100)));
}

TEST(AnnouncementPace, AlwaysKeepsTheLeastGap) {
  const PresenceConfig config;
  AnnouncementPace pace(config);
  pace.start(seconds(2));
  std::int64_t last = -1000;
  for (std::int64_t ms = 0; ms < 3000; ++ms) {
    const nanoseconds now = seconds(2) + milliseconds(ms);
    if (ms % 3 == 0) pace.announce_soon(now);
    if (ms % 5 == 0) pace.insist(now);
    if (ms % 7 == 0) pace.announce_by(now);
    if (!pace.is_due(now)) continue;
    pace.note_announced(now, false);
    EXPECT_GE(ms - last, 100);
    last = ms;
  }
  EXPECT_GT(last, 2800);
}

TEST(AnnouncementPace, InsistsEvenWhereAllListUs) {
  const PresenceConfig config;
  AnnouncementPace pace(config);
  pace.start(seconds(2));
  EXPECT_EQ(left_by(pace, 0, 1500, true), (std::vector<std::int64_t>{0, 1000}));
  pace.insist(seconds(2) + milliseconds(1500));
  EXPECT_EQ(left_by(pace, 1500, 3500, true),
            (std::vector<std::int64_t>{1500, 1650, 1800, 1950, 2100, 2250, 2400, 2550, 2700, 2850,
                                       3000}));
}

TEST(AnnouncementPace, EndsItsRepetitionOnceAllListUs) {
  const PresenceConfig config;
  AnnouncementPace pace(config);
  pace.start(seconds(2));
  EXPECT_FALSE(pace.is_repeating());
  EXPECT_EQ(left_by(pace, 0, 200), (std::vector<std::int64_t>{0, 150}));
  ASSERT_TRUE(pace.is_repeating());
  pace.end_repetition();
  EXPECT_FALSE(pace.is_repeating());
  EXPECT_EQ(pace.next(), seconds(2) + milliseconds(1150));
}

TEST(AnnouncementPace, AnnouncesLaterChangesOfItsSourceOnly) {
  const PresenceConfig config;
  AnnouncementPace pace(config);
  pace.start(seconds(2));
  left_by(pace, 0, 3200);
  const nanoseconds before = pace.next();
  pace.note_own_source(source(1, 3000), seconds(2) + milliseconds(3200));
  pace.note_own_source({}, seconds(2) + milliseconds(3200));
  EXPECT_EQ(pace.next(), before);
  pace.note_own_source(source(2, 3000), seconds(2) + milliseconds(3200));
  EXPECT_EQ(pace.next(), seconds(2) + milliseconds(3200));
}

}  // namespace
}  // namespace reckon::aoim
