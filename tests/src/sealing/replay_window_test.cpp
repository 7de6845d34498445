// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/sealing/replay_window.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace reckon::peer {
namespace {

TEST(ReplayWindow, TakesEachCountOnceAndNoneBelowOne) {
  ReplayWindow window;
  EXPECT_FALSE(window.is_fresh(0));
  EXPECT_TRUE(window.is_fresh(1));
  window.take(1);
  EXPECT_FALSE(window.is_fresh(1));
  EXPECT_FALSE(window.is_fresh(0));
}

TEST(ReplayWindow, ReachesExactly1024Back) {
  ReplayWindow window;
  window.take(5000);
  EXPECT_TRUE(window.is_fresh(5000 - 1023));
  EXPECT_FALSE(window.is_fresh(5000 - 1024));
}

// Compared with a set that keeps everything, for counts out of order, with jumps of up to three
// windows.
TEST(ReplayWindow, MatchesASetOfAllTakenCounts) {
  std::mt19937_64 random(3);
  ReplayWindow window;
  std::set<std::uint64_t> taken;
  std::uint64_t newest = 0;
  for (int i = 0; i < 200000; ++i) {
    const bool leap = random() % 500 == 0;
    const std::uint64_t ahead = newest + random() % (leap ? 3000 : 4);
    const std::uint64_t behind = random() % 1200;
    const std::uint64_t count = random() % 2 == 0 ? ahead : newest - std::min(newest, behind);
    const bool fresh = count > newest || (count > 0 && newest - count < ReplayWindow::kSpan &&
                                          !taken.contains(count));
    ASSERT_EQ(window.is_fresh(count), fresh) << count << " after " << newest;
    if (!fresh) continue;
    window.take(count);
    taken.insert(count);
    newest = std::max(newest, count);
  }
}

}  // namespace
}  // namespace reckon::peer
