// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/groups/sequence_tracker.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <tuple>
#include <vector>

namespace reckon::aoim::sequence_tracker_test {
namespace {

constexpr GroupIndex kGroup{3};

struct Planted {
  std::uint64_t lost = 0, duplicated = 0, reordered = 0;
};

struct Arrival {
  double when;
  std::uint32_t sequence;
};

/// Loses, duplicates and reorders a stream; returns the counts of a perfect observer in `planted`.
std::vector<Arrival> mistreat(std::uint32_t first, std::uint32_t count, double spread,
                              std::uint64_t seed, Planted& planted) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  std::vector<Arrival> arrivals;
  for (std::uint32_t i = 0; i < count; ++i) {
    const bool edge = i == 0 || i + 1 == count;
    if (!edge && u(random) < 0.05) {
      ++planted.lost;
      continue;
    }
    const int copies = u(random) < 0.03 ? 2 : 1;
    for (int copy = 0; copy < copies; ++copy) {
      const double shift = u(random) < 0.2 ? u(random) * spread : 0.0;
      arrivals.push_back({i + (edge ? 0.0 : shift), first + i});
    }
    planted.duplicated += static_cast<std::uint64_t>(copies - 1);
  }
  std::sort(arrivals.begin(), arrivals.end(), [](const Arrival& a, const Arrival& b) {
    return std::tie(a.when, a.sequence) < std::tie(b.when, b.sequence);
  });
  std::uint32_t highest = 0;
  std::set<std::uint32_t> seen;
  for (const Arrival& arrival : arrivals) {
    const std::uint32_t offset = arrival.sequence - first;
    if (seen.insert(offset).second && offset < highest) ++planted.reordered;
    highest = std::max(highest, offset);
  }
  return arrivals;
}

TEST(SequenceTracker, CountsInjectedLossDuplicationAndReorderingExactly) {
  for (const std::uint32_t first : {1u, 0xFFFFFF00u}) {  // the second wraps
    for (const double spread : {5.0, 60.0, 200.0}) {
      Planted planted;
      const auto arrivals = mistreat(first, 50000, spread, 17, planted);
      SequenceTracker tracker;
      std::set<std::uint32_t> used;
      for (const Arrival& arrival : arrivals) {
        const SequenceVerdict verdict = tracker.note(42, kGroup, arrival.sequence);
        if (is_usable(verdict)) {
          EXPECT_TRUE(used.insert(arrival.sequence).second) << "one datagram was used twice";
        }
      }
      const SequenceCounts& counts = tracker.counts();
      EXPECT_EQ(counts.received, arrivals.size());
      EXPECT_EQ(counts.lost, planted.lost) << "spread " << spread;
      EXPECT_EQ(counts.duplicated, planted.duplicated);
      EXPECT_EQ(counts.reordered, planted.reordered);
      EXPECT_EQ(counts.too_old, 0u);
    }
  }
}

TEST(SequenceTracker, KeepsSendersAndGroupsApart) {
  SequenceTracker tracker;
  for (std::uint32_t sequence = 1; sequence <= 100; ++sequence) {
    for (std::uint32_t epoch = 1; epoch <= 20; ++epoch) {
      for (std::uint16_t group = 0; group < 10; ++group) {
        if (epoch == 7 && group == 3 && sequence == 50) continue;
        tracker.note(epoch, {group}, sequence);
      }
    }
  }
  EXPECT_EQ(tracker.size(), 200u);
  EXPECT_EQ(tracker.counts().lost, 1u);
}

TEST(SequenceTracker, CountsNumbersBelowTheFirstOne) {
  SequenceTracker tracker;
  for (const std::uint32_t sequence : {5u, 2u, 6u}) tracker.note(1, kGroup, sequence);
  EXPECT_EQ(tracker.counts().lost, 2u);  // 3 and 4
  EXPECT_EQ(tracker.counts().reordered, 1u);
  EXPECT_EQ(tracker.note(1, kGroup, 3), SequenceVerdict::late);
  EXPECT_EQ(tracker.note(1, kGroup, 3), SequenceVerdict::duplicate);
  EXPECT_EQ(tracker.counts().lost, 1u);
}

TEST(SequenceTracker, RefusesNumbersBehindTheWindow) {
  SequenceTracker tracker;
  tracker.note(1, kGroup, 1);
  tracker.note(1, kGroup, 999);
  tracker.note(1, kGroup, 1000);
  EXPECT_EQ(tracker.counts().lost, 997u);
  EXPECT_EQ(tracker.note(1, kGroup, 1000 - 255), SequenceVerdict::late);
  EXPECT_EQ(tracker.note(1, kGroup, 1000 - 256), SequenceVerdict::too_old);
  EXPECT_EQ(tracker.counts().lost, 996u);
}

TEST(SequenceTracker, OneFarNumberDoesNotInvalidateGenuineOnes) {
  SequenceTracker tracker;
  for (const std::uint32_t leap : {600u, 1000u, 1u << 16, 1u << 30, (1u << 31) - 1, 1u << 31}) {
    SCOPED_TRACE(leap);
    tracker.forget(kGroup);
    const SequenceCounts before = tracker.counts();
    std::uint32_t sequence = 5;
    tracker.note(1, kGroup, sequence);
    for (int i = 0; i < 40; ++i) {
      const std::uint32_t far = sequence + leap + 300u * static_cast<std::uint32_t>(i);
      EXPECT_NE(tracker.note(1, kGroup, far), SequenceVerdict::in_order);
      EXPECT_EQ(tracker.note(1, kGroup, ++sequence), SequenceVerdict::in_order);
    }
    EXPECT_EQ(tracker.counts().lost, before.lost);
  }
}

TEST(SequenceTracker, FollowsALeapThatASecondNumberConfirms) {
  SequenceTracker tracker;
  tracker.note(1, kGroup, 1);
  EXPECT_EQ(tracker.note(1, kGroup, 1u << 30), SequenceVerdict::leap);
  EXPECT_EQ(tracker.note(1, kGroup, 1u << 30), SequenceVerdict::duplicate);
  EXPECT_EQ(tracker.note(1, kGroup, (1u << 30) + 2), SequenceVerdict::in_order);
  EXPECT_EQ(tracker.counts().lost, 1u);  // the number between, not 2^30
  EXPECT_EQ(tracker.note(1, kGroup, (1u << 30) + 1), SequenceVerdict::late);
  EXPECT_EQ(tracker.note(1, kGroup, 1u << 30), SequenceVerdict::duplicate);
  EXPECT_EQ(tracker.counts().lost, 0u);

  // Then back again, as after a forged jump that was accepted.
  EXPECT_EQ(tracker.note(1, kGroup, 7), SequenceVerdict::too_old);
  EXPECT_EQ(tracker.note(1, kGroup, 8), SequenceVerdict::in_order);
  EXPECT_EQ(tracker.note(1, kGroup, 9), SequenceVerdict::in_order);
  EXPECT_EQ(tracker.counts().lost, 0u);
  EXPECT_EQ(tracker.counts().leaps, 2u);
}

// An outage counts as loss to the datagram, in whatever order the datagrams after it arrive.
TEST(SequenceTracker, CountsALongGapExactly) {
  for (const std::uint32_t begin : {1u, 0xFFFFFF00u}) {
    for (const std::vector<std::uint32_t>& end : std::vector<std::vector<std::uint32_t>>{
             {1000, 1001, 1002}, {1001, 1000, 1002}, {1002, 1000, 1001}, {1000, 999, 500, 1001}}) {
      SequenceTracker tracker;
      tracker.note(1, kGroup, begin);
      for (const std::uint32_t sequence : end) {
        EXPECT_TRUE(is_usable(tracker.note(1, kGroup, begin + sequence)) || sequence == 500);
      }
      const std::uint32_t highest = *std::max_element(end.begin(), end.end());
      const std::uint64_t lost = tracker.counts().lost;
      EXPECT_EQ(lost + 1 + tracker.counts().received - 1 - tracker.counts().too_old, highest + 1);
    }
  }
}

TEST(SequenceTracker, AcceptsNumbersThatWereTooFarAhead) {
  SequenceTracker tracker;
  for (const std::uint32_t sequence : {0u, 300u, 100u, 200u, 299u, 301u}) {
    EXPECT_TRUE(is_usable(tracker.note(1, kGroup, sequence))) << sequence;
  }
  EXPECT_EQ(tracker.note(1, kGroup, 300), SequenceVerdict::duplicate);
  EXPECT_EQ(tracker.counts().lost, 301u + 1 - 6);
}

TEST(SequenceTracker, CountsNoLossBetweenLeavingAndJoining) {
  SequenceTracker tracker;
  tracker.note(1, kGroup, 1);
  tracker.note(1, GroupIndex{4}, 1);
  tracker.note(2, kGroup, 1);
  tracker.forget(kGroup);
  EXPECT_EQ(tracker.size(), 1u);
  EXPECT_EQ(tracker.note(1, kGroup, 500), SequenceVerdict::first);
  EXPECT_EQ(tracker.note(1, GroupIndex{4}, 2), SequenceVerdict::in_order);
  EXPECT_EQ(tracker.counts().lost, 0u);
  tracker.forget(std::uint32_t{1});
  EXPECT_EQ(tracker.size(), 0u);
}

// Against a list with linear search.
TEST(SequenceTracker, EvictsTheLongestSilentSenderWhenFull) {
  SequenceTracker tracker(32);
  struct Heard {
    std::uint32_t epoch;
    std::uint16_t group;
    std::uint32_t sequence;
  };
  std::vector<Heard> heard;  // oldest first
  std::uint64_t given_up = 0;
  std::mt19937_64 random(3);
  for (int i = 0; i < 50000; ++i) {
    const auto epoch = static_cast<std::uint32_t>(random() % 8);
    const auto group = static_cast<std::uint16_t>(random() % 8);
    if (random() % 100 == 0) {
      tracker.forget(epoch);
      std::erase_if(heard, [&](const Heard& h) { return h.epoch == epoch; });
    }
    if (random() % 100 == 0) {
      tracker.forget(GroupIndex{group});
      std::erase_if(heard, [&](const Heard& h) { return h.group == group; });
    }
    const auto found = std::find_if(heard.begin(), heard.end(), [&](const Heard& h) {
      return h.epoch == epoch && h.group == group;
    });
    const bool known = found != heard.end();
    Heard now{epoch, group, known ? found->sequence + 1 : 1};
    if (known) heard.erase(found);
    if (heard.size() == 32) {
      heard.erase(heard.begin());
      ++given_up;
    }
    heard.push_back(now);
    ASSERT_EQ(tracker.note(epoch, {group}, now.sequence),
              known ? SequenceVerdict::in_order : SequenceVerdict::first);
    ASSERT_EQ(tracker.size(), heard.size());
    ASSERT_EQ(tracker.counts().given_up, given_up);
  }
  EXPECT_EQ(tracker.counts().lost, 0u);
  EXPECT_GT(given_up, 1000u);
}

// 100 peers in 30 groups each, one datagram in fifty lost: every loss is counted.
TEST(SequenceTracker, HoldsAHundredPeersInThirtyGroups) {
  SequenceTracker tracker;
  std::uint64_t lost = 0;
  for (std::uint32_t round = 0; round < 100; ++round) {
    for (std::uint32_t epoch = 1; epoch <= 100; ++epoch) {
      for (std::uint16_t group = 0; group < 30; ++group) {
        if (round % 50 == 25) {
          ++lost;
        } else {
          static_cast<void>(tracker.note(epoch, {group}, round));
        }
      }
    }
  }
  EXPECT_EQ(tracker.counts().lost, lost);
  EXPECT_EQ(tracker.counts().given_up, 0u);
}

}  // namespace
}  // namespace reckon::aoim::sequence_tracker_test
