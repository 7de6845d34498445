// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/cells/locale_map.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <set>
#include <stdexcept>
#include <vector>

#include "reckon/aoim/interest/subscription.hpp"

namespace reckon::aoim {
namespace {

constexpr double kQuarterTurn = 1.57079632679489661923;

// Three rooms in a row along x, each with another orientation. A wall separates the first from the
// fourth, which is north of it.
std::vector<Locale> rooms() {
  return {{{5, 5, 0}, 0.0, 5, 5, {1}},
          {{15, 5, 1}, kQuarterTurn, 5, 5, {0, 2}},
          {{25, 5, 2}, -kQuarterTurn, 5, 5, {1}},
          {{5, 15, 0}, 0.0, 5, 5, {}}};
}

std::set<int> within(const LocaleMap& map, const Position& p, double radius) {
  std::set<int> found;
  map.for_each_cell_within(p, radius, [&](CellId cell, double) { found.insert(cell.q); });
  return found;
}

TEST(LocaleMap, MapsEachPlaceToOneLocale) {
  const LocaleMap map(rooms());
  EXPECT_EQ(map.cell({1, 1, 0}), (CellId{0, 0}));
  EXPECT_EQ(map.cell({19.9, 9, 0}), (CellId{1, 0}));
  EXPECT_EQ(map.cell({20.1, 9, 0}), (CellId{2, 0}));
  EXPECT_EQ(map.cell({5, 40, 0}), (CellId{3, 0})) << "the nearest, outside of all";
  EXPECT_EQ(map.group(Position{20.1, 9, 0}), GroupIndex{3});
  EXPECT_EQ(map.group(CellId{77, 0}), GroupIndex{1});
  EXPECT_EQ(map.group(CellId{-1, 0}), GroupIndex{1});
}

TEST(LocaleMap, TransformsIntoALocalesFrameAndBack) {
  const LocaleMap map(rooms());
  const Position local = map.to_locale({1, 0}, {15, 8, 3});
  EXPECT_NEAR(local.x, 3.0, 1e-12);  // north is its x axis
  EXPECT_NEAR(local.y, 0.0, 1e-12);
  EXPECT_NEAR(local.z, 2.0, 1e-12);
}

TEST(LocaleMap, MovesNothingWhenABorderIsCrossed) {
  const LocaleMap map(rooms());
  Position before{};
  CellId last{-1, 0};
  std::size_t crossings = 0;
  for (int i = 0; i <= 30'000; ++i) {
    const Position p{0.001 * i, 4.0 + 1e-4 * i, 1.0};
    const CellId cell = map.cell(p);
    crossings += last.q >= 0 && cell != last ? 1 : 0;
    last = cell;
    const Position seen = map.to_scene(cell, map.to_locale(cell, p));
    EXPECT_NEAR(distance(seen, p), 0.0, 1e-12);
    if (i > 0) {
      EXPECT_LT(distance(seen, before), 0.0011);
    }
    before = seen;
  }
  EXPECT_EQ(crossings, 2U);
}

TEST(LocaleMap, ReachesNeighboursButNothingBehindAWall) {
  const LocaleMap map(rooms());
  EXPECT_EQ(within(map, {9, 9, 0}, 0.5), (std::set{0}));
  EXPECT_EQ(within(map, {9, 9, 0}, 2.0), (std::set{0, 1})) << "the room above is behind a wall";
  EXPECT_EQ(within(map, {9, 9, 0}, 12.0), (std::set{0, 1, 2}));
  EXPECT_EQ(within(map, {5, 11, 0}, 100.0), (std::set{3}));
}

TEST(LocaleMap, BoundsTheGroupsThatADiscReaches) {
  const LocaleMap map(rooms());
  EXPECT_EQ(map.groups_bound(0.5), 2U);
  EXPECT_EQ(map.groups_bound(12.0), 3U);
  EXPECT_EQ(map.groups_bound(1000.0), 3U) << "the fourth room has no way to the others";
  EXPECT_EQ(map.finest(), 10.0);
}

TEST(LocaleMap, DistinguishesFloorsByHeight) {
  std::vector<Locale> floors = {{{0, 0, 0}, 0.0, 5, 5, {1}, 2.0}, {{0, 0, 4}, 0.0, 5, 5, {0}, 2.0}};
  const LocaleMap map(floors);
  EXPECT_EQ(map.cell({1, 1, 1.9}), (CellId{0, 0}));
  EXPECT_EQ(map.cell({1, 1, 2.1}), (CellId{1, 0}));
  EXPECT_EQ(within(map, {1, 1, 0.0}, 1.9), (std::set{0}));
  EXPECT_EQ(within(map, {1, 1, 0.0}, 2.1), (std::set{0, 1}));
  EXPECT_EQ(map.groups_bound(0.1), 2U);
}

// Random houses: the locales reached through neighbours within the radius equal those of an
// independent search, and groups_bound() covers their number.
TEST(LocaleMap, ReachesTheSameLocalesAsAnExhaustiveSearch) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> place(-50.0, 50.0), half(1.0, 12.0), turn(-4.0, 4.0),
      size(0.0, 60.0);
  for (int house = 0; house < 30; ++house) {
    std::vector<Locale> locales(12);
    for (Locale& locale : locales)
      locale = {{place(random), place(random), 0}, turn(random), half(random), half(random), {}};
    for (std::uint16_t a = 0; a < locales.size(); ++a) {
      for (std::uint16_t b = 0; b < a; ++b) {
        if (random() % 3 != 0) continue;
        locales[a].neighbours.push_back(b);
        locales[b].neighbours.push_back(a);
      }
    }
    const LocaleMap map(locales);
    for (int i = 0; i < 50; ++i) {
      const Position p{place(random), place(random), 0};
      const double radius = size(random);
      std::set<int> expected{map.cell(p).q};
      for (std::size_t before = 0; before < expected.size();) {
        before = expected.size();
        for (const int from : std::set<int>(expected)) {
          for (const std::uint16_t to : locales[static_cast<std::size_t>(from)].neighbours)
            if (map.distance({to, 0}, p) <= radius) expected.insert(to);
        }
      }
      EXPECT_EQ(within(map, p, radius), expected);
      EXPECT_LE(map.distance(map.cell(p), p) > 0.0 ? 0U : expected.size(),
                map.groups_bound(radius));
    }
  }
}

TEST(LocaleMap, IsSubscribedToLikeAGrid) {
  Subscription subscription(LocaleMap(rooms()), {});
  const Focus focus{{9, 9, 0}, 0.0, 2.0};
  const SubscriptionChange change = subscription.update({&focus, 1}, std::chrono::seconds(0));
  ASSERT_EQ(change.join.size(), 2U);
  EXPECT_EQ(change.join[1], GroupIndex{2});
}

TEST(LocaleMap, RefusesInvalidMaps) {
  const auto refuses = [](auto spoil) {
    std::vector<Locale> locales = rooms();
    spoil(locales);
    EXPECT_THROW(LocaleMap{locales}, std::invalid_argument);
  };
  refuses([](auto& l) { l.clear(); });
  refuses([](auto& l) { l[0].half_x = 0.0; });
  refuses([](auto& l) { l[0].yaw = std::numeric_limits<double>::infinity(); });
  refuses([](auto& l) { l[0].neighbours = {9}; });
  refuses([](auto& l) { l[0].neighbours = {0}; });
  refuses([](auto& l) { l[3].neighbours = {0}; });  // no reference back
}

}  // namespace
}  // namespace reckon::aoim
