// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One stream for all receivers: as detailed as the most demanding receiver needs.
#include "reckon/aoim/interest/receiver_channels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace reckon::aoim {
namespace {

ReceiverChannels channels() { return ReceiverChannels(default_channels()); }

TEST(ReceiverChannels, ServeTheNearestReceiver) {
  ReceiverChannels to = channels();
  to.add({500, 0, 0});
  ASSERT_NE(to.of({0, 0, 0}), nullptr);
  EXPECT_EQ(to.of({0, 0, 0})->active_hz, 1.0);
  to.add({150, 0, 0});
  EXPECT_EQ(to.of({0, 0, 0})->active_hz, 10.0);
  to.add({0, 30, 0});
  EXPECT_EQ(to.of({0, 0, 0})->active_hz, 30.0);
  to.add({0, 0, 0.9});
  EXPECT_TRUE(to.of({0, 0, 0})->kept);
  EXPECT_DOUBLE_EQ(to.nearest({0, 0, 0}), 0.9);
  to.clear();
  EXPECT_EQ(to.of({0, 0, 0})->active_hz, 1.0) << "nobody is known";
}

TEST(ReceiverChannels, ScaleDistancesPerReceiverExceptInContact) {
  ReceiverChannels to = channels();
  to.add({30, 0, 0}, 2.0);
  EXPECT_EQ(to.of({0, 0, 0})->active_hz, 10.0) << "30 m count as 60";
  to.add({0, 40, 0});
  EXPECT_EQ(to.of({0, 0, 0})->active_hz, 30.0) << "another takes all";
  to.clear();
  to.add({0, 0, 1}, 1000.0);
  EXPECT_TRUE(to.of({0, 0, 0})->kept);
}

// With groups for near rows: a row is served before an approaching receiver arrives in it.
TEST(ReceiverChannels, ServeARowForPresentAndApproachingReceivers) {
  ReceiverChannels to = channels();
  const Position here{0, 0, 0};
  EXPECT_EQ(to.served_row(here, 0.0, 0.0), 2u) << "nobody is known";
  to.add({250, 0, 0});
  EXPECT_EQ(to.served_row(here, 0.0, 0.0), 2u);
  EXPECT_EQ(to.served_row(here, 0.0, 31.0), 1u) << "within 1.1 x 200 m of where it may be";
  EXPECT_EQ(to.served_row(here, 101.0, 1.0), 1u) << "31.3 m in 0.3 s";
  EXPECT_EQ(to.served_row(here, 95.0, 1.0), 2u);
  to.add({80, 0, 0}, 1.0, 100.0);
  EXPECT_EQ(to.served_row(here, 0.0, 0.0), 0u) << "30 m nearer in 0.3 s";
  to.clear();
  to.add({80, 0, 0}, 1.0, 50.0);
  EXPECT_EQ(to.served_row(here, 0.0, 0.0), 1u);
  to.clear();
  to.add({30, 0, 0}, 2.0);
  EXPECT_EQ(to.served_row(here, 0.0, 0.0), 1u) << "30 m count as 60";
  to.clear();
  to.add({0.5, 0, 0});
  EXPECT_EQ(to.served_row(here, 0.0, 0.0), 0u) << "kept rows are said by the next one's group";
}

TEST(ReceiverChannels, IgnoreReceiversWithoutAValidPosition) {
  ReceiverChannels to = channels();
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  to.add({kNaN, 0, 0});
  to.add({0, 0, 0}, kNaN);
  to.add({0, 0, 0}, 0.5);
  EXPECT_EQ(to.size(), 0u);
}

TEST(ReceiverChannels, AreNullBeyondAFiniteTable) {
  const Channel near{10.0, Body::full, 5.0, 1.0, 144.0, false};
  ReceiverChannels to({&near, 1});
  EXPECT_NE(to.of({0, 0, 0}), nullptr) << "nobody is known";
  to.add({11, 0, 0});
  EXPECT_EQ(to.of({0, 0, 0}), nullptr);
}

TEST(ReceiverChannels, AgreeWithTheTableForEachReceiver) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> place(-300, 300), octaves(0, 4);
  const ChannelTable table;
  for (int round = 0; round < 500; ++round) {
    ReceiverChannels to = channels();
    std::size_t richest = table.size();
    for (int i = 0; i < 5; ++i) {
      const Position at{place(random), place(random), place(random)};
      const double stretch = std::exp2(octaves(random));
      to.add(at, stretch);
      richest = std::min(richest, table.row(std::hypot(at.x, at.y, at.z), stretch));
    }
    EXPECT_EQ(to.of({0, 0, 0})->farthest, table.channel(richest).farthest);
  }
}

}  // namespace
}  // namespace reckon::aoim
