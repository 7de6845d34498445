// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/interest/subscription.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <random>

namespace reckon::aoim {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

constexpr double kRadius = 200.0;

GridConfig grid_config(CellScheme scheme = CellScheme::hexagonal) {
  GridConfig config;
  config.scheme = scheme;
  return config;
}

SubscriptionConfig uncapped() {
  SubscriptionConfig config;
  config.maximum_groups = 256;
  return config;
}

/// Walks at constant speed and turns sharply at every step.
struct Wanderer {
  explicit Wanderer(std::uint64_t seed, double speed_) : random(seed), speed(speed_) {}
  void walk(double dt) {
    heading += std::normal_distribution<double>(0.0, 0.3)(random);
    if (random() % 50 == 0) heading += std::numbers::pi;
    position.x += speed * dt * std::cos(heading);
    position.y += speed * dt * std::sin(heading);
  }
  Position inside() {
    const double r = kRadius * std::sqrt(std::uniform_real_distribution<double>(0, 1)(random));
    const double a = std::uniform_real_distribution<double>(0, 2 * std::numbers::pi)(random);
    return {position.x + r * std::cos(a), position.y + r * std::sin(a), 0.0};
  }
  Focus focus() const { return {position, speed, kRadius}; }

  std::mt19937_64 random;
  double speed;
  Position position;
  double heading = 0.0;
};

/// Number of updates from inside R whose group was joined too late.
int updates_lost(double speed, nanoseconds lookahead, nanoseconds join_takes, std::uint64_t seed) {
  const CellGrid grid(grid_config());
  SubscriptionConfig config = uncapped();
  config.lookahead = lookahead;
  Subscription subscription(grid, config);
  Wanderer me(seed, speed);
  std::map<GroupIndex, nanoseconds> effective;
  int lost = 0;
  const nanoseconds step = milliseconds(20);
  for (nanoseconds now{0}; now < seconds(120); now += step) {
    const Focus focus = me.focus();
    const SubscriptionChange change = subscription.update({&focus, 1}, now);
    for (const GroupIndex group : change.join) effective[group] = now + join_takes;
    for (const GroupIndex group : change.leave) effective.erase(group);
    if (now < milliseconds(100)) continue;
    for (int i = 0; i < 20; ++i) {
      const auto joined = effective.find(grid.group(me.inside()));
      lost += joined == effective.end() || joined->second > now ? 1 : 0;
    }
    me.walk(std::chrono::duration<double>(step).count());
  }
  return lost;
}

TEST(Subscription, AlwaysCoversTheFocusAlongRandomPaths) {
  for (const CellScheme scheme : {CellScheme::square, CellScheme::hexagonal}) {
    const CellGrid grid(grid_config(scheme));
    Subscription subscription(grid, uncapped());
    std::vector<Wanderer> walkers;
    for (int i = 0; i < 3; ++i) walkers.emplace_back(11 + i, 30.0 * i);
    std::vector<Focus> foci;
    for (nanoseconds now{0}; now < seconds(60); now += milliseconds(33)) {
      foci.clear();
      for (Wanderer& walker : walkers) {
        walker.walk(0.033);
        foci.push_back(walker.focus());
      }
      const SubscriptionChange change = subscription.update(foci, now);
      ASSERT_EQ(change.uncovered, 0u);
      for (const Focus& focus : foci) {
        grid.for_each_cell_within(focus.position, focus.radius, [&](CellId cell, double) {
          ASSERT_TRUE(subscription.is_joined(grid.group(cell)));
        });
      }
    }
  }
}

TEST(Subscription, LosesNoUpdateWithinTheRadiusWhileJoining) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    for (const double speed : {1.5, 15.0, 60.0}) {
      EXPECT_EQ(updates_lost(speed, milliseconds(100), milliseconds(30), seed), 0)
          << "seed " << seed << ", " << speed << " m/s";
    }
  }
}

TEST(Subscription, WouldLoseSomeWithoutThePreJoin) {
  EXPECT_GT(updates_lost(60.0, milliseconds(0), milliseconds(30), 1), 0);
}

TEST(Subscription, DoesNotFlapAtABorder) {
  const CellGrid grid(grid_config());
  Subscription subscription(grid, uncapped());
  Focus focus{{0, 0, 0}, 0.0, kRadius};
  std::size_t joins = 0, leaves = 0;
  for (int i = 0; i < 3000; ++i) {
    // Moves to and fro by 5 m at 1 Hz: the edge of R crosses cell borders all the time.
    focus.position.x = 62.0 + 5.0 * std::sin(2 * std::numbers::pi * i / 100.0);
    const SubscriptionChange change = subscription.update({&focus, 1}, i * milliseconds(10));
    if (i > 100) joins += change.join.size();
    leaves += change.leave.size();
  }
  EXPECT_EQ(joins, 0u) << "after the first period nothing new is within reach";
  EXPECT_EQ(leaves, 0u);
}

TEST(Subscription, KeepsAGroupForAtLeastTwoSeconds) {
  const CellGrid grid(grid_config());
  Subscription subscription(grid, uncapped());
  Focus focus{{0, 0, 0}, 0.0, 50.0};
  subscription.update({&focus, 1}, seconds(10));
  const GroupIndex home = grid.group(Position{0, 0, 0});
  ASSERT_TRUE(subscription.is_joined(home));

  focus.position.x = 900.0;  // a jump
  EXPECT_TRUE(subscription.update({&focus, 1}, seconds(11)).leave.empty());
  EXPECT_TRUE(subscription.is_joined(home));
  EXPECT_TRUE(subscription.is_joined_since(home, seconds(10)));
  subscription.update({&focus, 1}, seconds(12));
  EXPECT_FALSE(subscription.is_joined(home));
  focus.position.x = 0.0;
  subscription.update({&focus, 1}, seconds(13));
  EXPECT_FALSE(subscription.is_joined_since(home, seconds(12))) << "it was left in the meantime";
  EXPECT_TRUE(subscription.is_joined_since(home, seconds(13)));
}

TEST(Subscription, LeavesOnlyBeyondElevenTenthsOfTheRadius) {
  const CellGrid grid(grid_config(CellScheme::square));
  Subscription subscription(grid, uncapped());
  const GroupIndex origin = grid.group(Position{1, 1, 0});
  Focus focus{{100, 60, 0}, 0.0, kRadius};
  subscription.update({&focus, 1}, seconds(0));
  ASSERT_TRUE(subscription.is_joined(origin));

  // The cell of the origin ends at x = 125.
  focus.position.x = 125.0 + 1.09 * kRadius;
  subscription.update({&focus, 1}, seconds(10));
  EXPECT_TRUE(subscription.is_joined(origin));
  focus.position.x = 125.0 + 1.11 * kRadius;
  subscription.update({&focus, 1}, seconds(20));
  EXPECT_FALSE(subscription.is_joined(origin));
}

TEST(Subscription, KeepsTheNearestGroupsAtTheCap) {
  const CellGrid grid(grid_config());
  SubscriptionConfig config;
  config.maximum_groups = 7;
  Subscription subscription(grid, config);
  const Focus focus{{3, 4, 0}, 0.0, 500.0};
  const SubscriptionChange change = subscription.update({&focus, 1}, seconds(0));
  EXPECT_EQ(subscription.joined().size(), 7u);
  EXPECT_GT(change.uncovered, 10u);
  EXPECT_GT(change.covered_share, 0.2);
  EXPECT_LT(change.covered_share, 0.5);
  grid.for_each_cell_within(
      focus.position, change.covered_share * focus.radius * 0.999,
      [&](CellId cell, double) { EXPECT_TRUE(subscription.is_joined(grid.group(cell))); });

  // At the cap, a focus at rest causes no change.
  for (int i = 1; i < 100; ++i) {
    const SubscriptionChange next = subscription.update({&focus, 1}, i * milliseconds(100));
    EXPECT_TRUE(next.join.empty());
    EXPECT_TRUE(next.leave.empty());
  }
}

TEST(Subscription, ReceivesAllWithinTheRadiusWithSmallCells) {
  // Squares of 1 m and a radius of 3 m need 37 groups or more; every position within 3 m must be
  // covered.
  GridConfig small = grid_config(CellScheme::square);
  small.cell_size = 1.0;
  const CellGrid grid(small);
  Subscription subscription(grid, {});
  std::mt19937_64 random(2);
  for (int i = 0; i < 1000; ++i) {
    const Focus focus{{0.01 * i, -0.007 * i, 0.0}, 1.0, 3.0};
    const auto change = subscription.update({&focus, 1}, i * milliseconds(20));
    ASSERT_EQ(change.uncovered, 0u);
    ASSERT_EQ(change.covered_share, 1.0);
    const double angle = std::uniform_real_distribution<double>(0, 6.3)(random);
    const Position peer{focus.position.x + 2.5 * std::cos(angle),
                        focus.position.y + 2.5 * std::sin(angle), 0.0};
    ASSERT_TRUE(subscription.is_joined(grid.group(peer))) << i;
  }
}

TEST(Subscription, NeverExceedsTheCapWhileMoving) {
  const CellGrid grid(grid_config());
  SubscriptionConfig config;
  config.maximum_groups = 20;
  Subscription subscription(grid, config);
  Wanderer me(5, 200.0);
  for (nanoseconds now{0}; now < seconds(60); now += milliseconds(20)) {
    me.walk(0.02);
    const Focus focus = me.focus();
    subscription.update({&focus, 1}, now);
    ASSERT_LE(subscription.joined().size(), 20u);
  }
}

TEST(Subscription, JoinsAllGroupsForAHugeRadius) {
  const CellGrid grid(grid_config());
  Subscription subscription(grid, uncapped());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Focus> broken{
      {{nan, 0, 0}, 0.0, 10.0}, {{0, 0, 0}, nan, 10.0}, {{0, 0, 0}, 0.0, nan}};
  EXPECT_TRUE(subscription.update(broken, seconds(0)).join.empty());
  for (const double radius : {1e5, 1e300, std::numeric_limits<double>::infinity()}) {
    const Focus focus{{0, 0, 0}, 0.0, radius};
    subscription.update({&focus, 1}, seconds(1));
    EXPECT_EQ(subscription.joined().size(), 256u);
  }
}

TEST(Subscription, JoinsAboutEightHexagonGroupsInTheTown) {
  // Recorded town traffic (2,002 hosts, R = 200 m) gave 8.3 groups per host for hexagons of this
  // size.
  const CellGrid grid(grid_config());
  Subscription subscription(grid, uncapped());
  Wanderer me(9, 14.0);
  double sum = 0.0;
  int count = 0;
  for (nanoseconds now{0}; now < seconds(300); now += milliseconds(100)) {
    me.walk(0.1);
    const Focus focus = me.focus();
    subscription.update({&focus, 1}, now);
    sum += static_cast<double>(subscription.joined().size());
    ++count;
  }
  EXPECT_NEAR(sum / count, 8.6, 1.2);
}

}  // namespace
}  // namespace reckon::aoim
