// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/interest/focus_cover.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <set>
#include <vector>

#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::aoim::focus_cover_test {
namespace {

constexpr double kCell = 125.0;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// In long double, so that rounding of this check hides no error.
bool holds(const Focus& focus, const Focus& entity) {
  const long double x = static_cast<long double>(focus.position.x) - entity.position.x;
  const long double y = static_cast<long double>(focus.position.y) - entity.position.y;
  const long double z = static_cast<long double>(focus.position.z) - entity.position.z;
  return std::sqrt(x * x + y * y + z * z) + entity.radius <= focus.radius &&
         focus.speed >= entity.speed;
}

void expect_covered(std::span<const Focus> entities, std::span<const Focus> foci) {
  ASSERT_LE(foci.size(), FocusCover::kMostFoci);
  for (const Focus& entity : entities) {
    const bool covered = std::any_of(foci.begin(), foci.end(),
                                     [&](const Focus& focus) { return holds(focus, entity); });
    ASSERT_TRUE(covered) << entity.position.x << ' ' << entity.position.y << ' ' << entity.radius;
  }
}

std::vector<Focus> scattered(std::size_t count, double extent, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> along(-extent, extent), unit(0.0, 1.0);
  std::vector<Focus> entities(count);
  for (Focus& entity : entities) {
    entity = {{along(random), along(random), 0.1 * along(random)},
              50.0 * unit(random),
              200.0 * unit(random)};
  }
  return entities;
}

TEST(FocusCover, KeepsASingleEntityBitForBit) {
  FocusCover cover(kCell);
  for (const Focus& one :
       {Focus{{0.1, -0.3, 1e-310}, 0.7, 2.0}, Focus{{-1e300, 1e6, 0.0}, 0.0, 0.0},
        Focus{{-0.0, 124.99999999999999, 3.3}, kInfinity, kInfinity}}) {
    const auto foci = cover.cover({&one, 1});
    ASSERT_EQ(foci.size(), 1u);
    EXPECT_EQ(std::memcmp(foci.data(), &one, sizeof one), 0);
  }
}

TEST(FocusCover, CoversAnyEntitiesWithSixtyFourFoci) {
  FocusCover cover(kCell);
  for (const std::size_t count : {2u, 63u, 64u, 65u, 1000u, 20000u}) {
    for (const double extent : {1e-9, 1.0, 100.0, 1e4, 1e6, 1e30}) {
      const auto entities = scattered(count, extent, count);
      const auto foci = cover.cover(entities);
      expect_covered(entities, foci);
    }
  }
}

TEST(FocusCover, KeepsTwoDistantCrowdsSeparate) {
  std::vector<Focus> entities = scattered(500, 20.0, 3);
  for (std::size_t i = 0; i < entities.size(); i += 2) entities[i].position.x += 1e5;
  FocusCover cover(kCell);
  const auto foci = cover.cover(entities);
  expect_covered(entities, foci);
  EXPECT_LE(foci.size(), 8u);  // each crowd covers at most four squares
  for (const Focus& focus : foci) EXPECT_LT(focus.radius, 200.0 + 60.0);
}

TEST(FocusCover, EnlargesFocusByAtMostHalfADiagonal) {
  // 64 by 64 entities, one a cell: squares of eight cells are the smallest with at most 64 foci.
  std::vector<Focus> entities;
  for (int i = 0; i < 64 * 64; ++i) {
    entities.push_back({{kCell * (i % 64 + 0.5), kCell * (i / 64 + 0.5), 0.0}, 1.0, 200.0});
  }
  FocusCover cover(kCell);
  const auto foci = cover.cover(entities);
  expect_covered(entities, foci);
  ASSERT_EQ(foci.size(), 64u);
  const double away = 3.5 * std::sqrt(2.0) * kCell;
  for (const Focus& focus : foci) EXPECT_NEAR(focus.radius, 200.0 + away, 1e-9);
}

TEST(FocusCover, IsDeterministicAndAllocatesNothing) {
  const auto entities = scattered(5000, 1e5, 8);
  FocusCover a(kCell), b(kCell);
  const auto first = a.cover(entities);
  (void)b.cover(std::span(entities).first(70));
  const reckon::test::AllocationGuard guard;
  const auto second = b.cover(entities);
  EXPECT_EQ(guard.count(), 0u);
  ASSERT_EQ(first.size(), second.size());
  EXPECT_EQ(std::memcmp(first.data(), second.data(), first.size_bytes()), 0);
}

TEST(FocusCover, SkipsNonFiniteFociAndIgnoresBadSpeed) {
  const std::vector<Focus> entities{{{kNan, 0, 0}, 0.0, 10.0}, {{0, kInfinity, 0}, 0.0, 10.0},
                                    {{0, 0, 0}, 0.0, kNan},    {{0, 0, 0}, 0.0, -1.0},
                                    {{1, 2, 3}, kNan, 5.0},    {{2, 2, 3}, -7.0, 5.0}};
  FocusCover cover(kCell);
  EXPECT_TRUE(cover.cover(std::span(entities).first(4)).empty());
  EXPECT_TRUE(cover.cover({}).empty());
  const auto foci = cover.cover(entities);
  ASSERT_EQ(foci.size(), 1u);
  EXPECT_EQ(foci[0].position, (Position{1.5, 2, 3}));
  EXPECT_EQ(foci[0].speed, 0.0);
  EXPECT_NEAR(foci[0].radius, 5.5, 1e-12);
}

// A corridor of rooms with walls between them; only the first two are connected.
LocaleMap corridor(std::uint16_t rooms) {
  std::vector<Locale> locales;
  for (std::uint16_t i = 0; i < rooms; ++i) locales.push_back({{10.0 * i, 0, 0}, 0.0, 5, 5});
  locales[0].neighbours = {1};
  locales[1].neighbours = {0};
  return LocaleMap(locales);
}

std::set<std::uint16_t> reached_by(const LocaleMap& map, std::span<const Focus> foci) {
  Subscription subscription(map, {});
  subscription.update(foci, std::chrono::seconds(0));
  std::set<std::uint16_t> groups;
  for (const GroupIndex group : subscription.joined()) groups.insert(group.value);
  return groups;
}

TEST(FocusCover, SeparatesEntitiesInDifferentLocales) {
  const LocaleMap map = corridor(4);
  FocusCover cover{CellPartition(map)};
  // All in one square: two in the second room, one in the third. A ball of that size around the
  // latter would reach the fourth.
  const std::vector<Focus> entities = {
      {{13.0, 1.0, 0}, 1.0, 9.0}, {{17.0, 1.0, 0}, 0.0, 9.0}, {{12.0, 2.0, 0}, 2.0, 9.0}};
  const auto foci = cover.cover(entities);
  EXPECT_EQ(foci.size(), 2U);
  std::set<std::uint16_t> each;
  for (const Focus& entity : entities) each.merge(reached_by(map, {&entity, 1}));
  EXPECT_EQ(each, (std::set<std::uint16_t>{1, 2, 3}));
  EXPECT_EQ(reached_by(map, foci), each);
}

TEST(FocusCover, ReachesAllThatEachEntityReaches) {
  std::mt19937_64 random(21);
  for (const std::uint16_t rooms : std::initializer_list<std::uint16_t>{3, 40, 200}) {
    const LocaleMap map = corridor(rooms);
    std::uniform_real_distribution<double> along(-5.0, 10.0 * rooms), across(-5.0, 5.0);
    for (int turn = 0; turn < 20; ++turn) {
      FocusCover cover{CellPartition(map)};
      std::vector<Focus> entities(500);
      for (Focus& entity : entities) entity = {{along(random), across(random), 0}, 0.0, 4.0};
      const auto foci = cover.cover(entities);
      EXPECT_LE(foci.size(), FocusCover::most(&map));
      const std::set<std::uint16_t> all = reached_by(map, foci);
      for (const Focus& entity : entities)
        for (const std::uint16_t group : reached_by(map, {&entity, 1}))
          ASSERT_TRUE(all.contains(group)) << rooms << " rooms";
    }
  }
}

TEST(FocusCover, ReachesThroughNoWallWithManyLocales) {
  const LocaleMap map = corridor(1000);
  FocusCover cover{CellPartition(map)};
  std::vector<Focus> entities;
  std::set<std::uint16_t> each;
  for (std::uint16_t room = 4; room < 1000; room += 3) {  // 332 rooms, two rooms apart
    for (const double along : {-4.0, 0.0, 4.0}) {
      entities.push_back({{10.0 * room + along, 0, 0}, 0.0, 9.0});
      each.merge(reached_by(map, {&entities.back(), 1}));
    }
  }
  EXPECT_EQ(each.size(), 332U);
  const test::AllocationGuard guard;
  const auto foci = cover.cover(entities);
  EXPECT_EQ(guard.count(), 0U);
  EXPECT_EQ(foci.size(), 332U);
  EXPECT_EQ(reached_by(map, foci), each);
}

}  // namespace
}  // namespace reckon::aoim::focus_cover_test
