// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/presence/introduction.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <vector>

#include "reckon/tests/aoim/support/samples.hpp"

namespace reckon::aoim {
namespace {

using namespace test;

constexpr int kEntities = 1000;
constexpr GroupIndex kGroup{12};

pdu::EntityId entity(int i) { return {7, 1, static_cast<std::uint16_t>(i + 1)}; }

/// Asks every millisecond and notes the send times of each entity.
struct Owner {
  std::map<int, std::vector<nanoseconds>> sent;
  std::vector<nanoseconds> last = std::vector<nanoseconds>(kEntities, -seconds(100));
  void step(const Introduction& introduction, nanoseconds now) {
    for (int i = 0; i < kEntities; ++i) {
      if (!introduction.is_due(entity(i), kGroup, last[static_cast<std::size_t>(i)], now)) continue;
      last[static_cast<std::size_t>(i)] = now;
      sent[i].push_back(now);
    }
  }
};

TEST(Introduction, SendsEveryEntityOnceWithinAHundredMilliseconds) {
  Introduction introduction({});
  Owner owner;
  introduction.begin(kBaseGroup, seconds(5));
  std::array<int, 7> bins{};
  for (int ms = 0; ms < 2000; ++ms) owner.step(introduction, seconds(5) + milliseconds(ms));
  ASSERT_EQ(owner.sent.size(), static_cast<std::size_t>(kEntities));
  for (const auto& [i, times] : owner.sent) {
    ASSERT_EQ(times.size(), 1u);
    const nanoseconds after = times[0] - seconds(5);
    EXPECT_GE(after, milliseconds(30));
    EXPECT_LE(after, milliseconds(100));
    ++bins[std::min<std::size_t>(
        6, static_cast<std::size_t>((after - milliseconds(30)) / milliseconds(10)))];
  }
  // Spread evenly: 143 expected per bin of 10 ms, 5 sigma is 55.
  for (const int bin : bins) EXPECT_NEAR(bin, kEntities / 7.0, 55);
}

/// Send time of each of `count` entities [ms] after a newcomer, asking every 2 ms.
std::vector<int> moments(std::size_t count) {
  Introduction introduction({});
  introduction.set_owned(count);
  introduction.begin(kBaseGroup, seconds(5));
  std::vector<nanoseconds> last(count, -seconds(100));
  std::vector<int> sent(count, -1);
  for (int ms = 0; introduction.is_pending(); ms += 2) {
    const nanoseconds now = seconds(5) + milliseconds(ms);
    introduction.expire(now);
    for (std::size_t i = 0; i < count; ++i) {
      const pdu::EntityId id{7, static_cast<std::uint16_t>(1 + i / 60000),
                             static_cast<std::uint16_t>(1 + i % 60000)};
      if (!introduction.is_due(id, kGroup, last[i], now)) continue;
      EXPECT_EQ(sent[i], -1) << "twice";
      last[i] = now;
      sent[i] = ms;
    }
  }
  return sent;
}

TEST(Introduction, SpreadsToFifteenThousandBundlesASecond) {
  for (const auto& [count, longest] : {std::pair{10u, 100}, {10'000u, 114}, {100'000u, 864}}) {
    const std::vector<int> sent = moments(count);
    std::vector<int> windows(100);
    for (const int ms : sent) {
      ASSERT_GE(ms, 30) << count << " entities: before the newcomer has joined, or never";
      ASSERT_LE(ms, longest + 2) << count << " entities";
      ++windows[static_cast<std::size_t>(ms / 10)];
    }
    // 10 ms at 15,000 datagrams of 8; plus a step of 2 ms and 5 sigma of the hash's spread.
    const int most = *std::max_element(windows.begin(), windows.end());
    EXPECT_LE(most, std::max(10, 1200 * 12 / 10 + 173)) << count;
    const int last = *std::max_element(sent.begin(), sent.end());
    EXPECT_GE(last, count > 10 ? longest - 10 : 30) << count;
  }
}

TEST(Introduction, KeepsANewcomersPaceWhileEntitiesChange) {
  Introduction introduction({});
  introduction.set_owned(100'000);
  EXPECT_EQ(introduction.spread(), milliseconds(30) + nanoseconds(833'333'333));
  introduction.begin(kBaseGroup, nanoseconds(0));
  introduction.set_owned(1);
  EXPECT_EQ(introduction.spread(), milliseconds(100)) << "never below the default";
  int due = 0;
  for (int i = 0; i < kEntities; ++i) {
    due += introduction.is_due(entity(i), kGroup, -seconds(100), milliseconds(100)) ? 1 : 0;
  }
  EXPECT_LT(due, kEntities / 5);
  introduction.set_owned(std::numeric_limits<std::size_t>::max());
  EXPECT_LT(introduction.spread(), std::chrono::hours(2));
  IntroductionConfig still;
  still.pace = 0.0;
  EXPECT_THROW(Introduction{still}, std::invalid_argument);
}

TEST(Introduction, GivesAnEntityTheSameMomentEveryTime) {
  Introduction a({}), b({});
  for (int i = 0; i < kEntities; ++i) EXPECT_EQ(a.delay(entity(i)), b.delay(entity(i)));
}

TEST(Introduction, ServesASecondNewcomerDuringTheFirst) {
  Introduction introduction({});
  Owner owner;
  introduction.begin(kBaseGroup, milliseconds(0));
  for (int ms = 0; ms < 500; ++ms) {
    if (ms == 50) introduction.begin(kBaseGroup, milliseconds(50));
    owner.step(introduction, milliseconds(ms));
  }
  for (const auto& [i, times] : owner.sent) {
    EXPECT_LE(times[0], milliseconds(100)) << "the first newcomer waits no longer for the second";
    EXPECT_GE(times.back(), milliseconds(80)) << "the second could not hear it before";
    EXPECT_LE(times.back(), milliseconds(150));
    EXPECT_LE(times.size(), 2u);
  }
}

// For any interval between newcomers: at most the owned entities are sent within the time of a
// round.
TEST(Introduction, KeepsThePaceForNewcomersInARow) {
  for (const int apart : {1, 5, 20, 60, 150}) {
    Introduction introduction({});
    Owner owner;
    const int round = 70;  // [ms], spread minus settle time
    const int end = 40 * apart;
    for (int ms = 0; ms < end + 300; ++ms) {
      if (ms < end && ms % apart == 0) introduction.begin(kBaseGroup, milliseconds(ms));
      owner.step(introduction, milliseconds(ms));
    }
    std::vector<int> sent(static_cast<std::size_t>(end + 300));
    for (const auto& [i, times] : owner.sent) {
      for (const nanoseconds time : times) ++sent[static_cast<std::size_t>(time / milliseconds(1))];
      EXPECT_GE(times.back(), milliseconds(end - apart + 30)) << "the last has not heard it";
    }
    int within = 0, most = 0;
    for (std::size_t ms = 0; ms < sent.size(); ++ms) {
      within += sent[ms];
      if (ms >= round) within -= sent[ms - round];
      most = std::max(most, within);
    }
    // Each entity is polled once a millisecond, so the end of a round may overlap the start of the
    // next.
    EXPECT_LE(most, kEntities + kEntities / 25) << apart << " ms apart";
  }
}

TEST(Introduction, ConcernsOnlyTheGroupThatWasJoined) {
  Introduction introduction({});
  introduction.begin(GroupIndex{3}, nanoseconds(0));
  EXPECT_FALSE(introduction.is_due(entity(1), GroupIndex{4}, -seconds(1), milliseconds(100)));
  EXPECT_TRUE(introduction.is_due(entity(1), GroupIndex{3}, -seconds(1), milliseconds(100)));
}

TEST(Introduction, ConcernsNobodyElseWhenManyGroupsAreJoined) {
  Introduction introduction({});
  for (std::uint16_t i = 13; i < 240; ++i) introduction.begin(GroupIndex{i}, milliseconds(i));
  EXPECT_FALSE(introduction.is_due(entity(1), kGroup, -seconds(100), seconds(1)));
  EXPECT_TRUE(introduction.is_due(entity(1), GroupIndex{13}, -seconds(100), seconds(1)));
}

// A peer joins every few milliseconds for three seconds: each receives all states within a quarter
// of a second, sent after its joins have taken effect.
TEST(Introduction, ServesMoreNewcomersThanItDistinguishes) {
  for (const int apart : {1, 3, 10, 40}) {
    Introduction introduction({});
    Owner owner;
    for (int ms = 0; ms < 4000; ++ms) {
      if (ms < 3000 && ms % apart == 0) introduction.begin(kGroup, milliseconds(ms));
      introduction.expire(milliseconds(ms));
      owner.step(introduction, milliseconds(ms));
    }
    ASSERT_EQ(owner.sent.size(), static_cast<std::size_t>(kEntities));
    for (const auto& [i, times] : owner.sent) {
      for (int ms = 0; ms < 3000; ms += apart) {
        const auto heard = std::lower_bound(times.begin(), times.end(), milliseconds(ms + 30));
        ASSERT_NE(heard, times.end()) << "entity " << i << ", newcomer at " << ms;
        EXPECT_LE(*heard - milliseconds(ms), milliseconds(30 + 2 * 70 + 125)) << ms;
      }
    }
  }
}

TEST(Introduction, ForgetsAfterASecond) {
  Introduction introduction({});
  introduction.begin(kBaseGroup, seconds(1));
  introduction.expire(seconds(2));
  EXPECT_TRUE(introduction.is_pending());
  introduction.expire(seconds(2) + nanoseconds(1));
  EXPECT_FALSE(introduction.is_pending());
}

}  // namespace
}  // namespace reckon::aoim
