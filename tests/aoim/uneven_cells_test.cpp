// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Area-of-interest managers on cells of unequal size: against distances, at borders between cells
// of different size, and with other mechanisms that depend on cells.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "reckon/aoim/interest/focus_cover.hpp"
#include "reckon/tests/aoim/support/world.hpp"

namespace reckon::aoim {
namespace {

using namespace test;

constexpr double kSide = 4096.0;  // [m]

QuadTreeConfig square(std::size_t pool) {
  QuadTreeConfig result;
  result.side = kSide;
  result.pool = pool;
  return result;
}

// Four fifths in a village of 300 m, the rest all over the square.
std::vector<Position> lopsided(std::uint64_t seed, std::size_t count) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> all(-0.5 * kSide, 0.5 * kSide), village(900.0, 1200.0);
  std::vector<Position> places;
  for (std::size_t i = 0; i < count; ++i) {
    auto& along = i % 5 == 0 ? all : village;
    places.push_back({along(random), along(random), 0.0});
  }
  return places;
}

AreaOfInterestConfig with_tree(std::uint64_t seed, std::size_t pool = 64) {
  std::vector<Demand> demands;
  for (const Position& place : lopsided(seed, 500)) demands.push_back({place, 210.0, 0});
  AreaOfInterestConfig result = config();
  result.grid.pool = pool;
  result.cells.emplace(QuadTree::divided_by(square(pool), demands));
  result.subscription.leave_factor = 1.05;
  return result;
}

// Two rooms with a door, and one behind a wall of the first.
AreaOfInterestConfig with_rooms() {
  AreaOfInterestConfig result = config();
  result.cells.emplace(LocaleMap({{{0, 0, 0}, 0.0, 100, 100, {1}},
                                  {{200, 0, 0}, 0.0, 100, 100, {0}},
                                  {{0, 200, 0}, 0.0, 100, 100, {}}}));
  return result;
}

TEST(UnevenCells, ReachAllWithinTheRadiusInRandomWorlds) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const AreaOfInterestConfig how = with_tree(seed);
    AreaOfInterestManager manager(how, presence_of(1, 11));
    std::vector<Position> places = lopsided(seed + 100, 400);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> radius(0.0, 600.0);
    std::size_t within = 0, heard_outside = 0;
    for (std::size_t i = 0; i < 50; ++i) {
      const Focus focus{places[i], 0.0, radius(random)};
      manager.listen(kCellTier, {&focus, 1}, seconds(3 * i));
      for (const Position& other : places) {
        const bool hears = manager.subscriptions().hears(manager.route(other));
        const bool near = distance(focus.position, other) <= focus.radius;
        within += near;
        heard_outside += hears && !near;
        ASSERT_TRUE(hears || !near) << "seed " << seed << " focus " << i;
      }
    }
    EXPECT_GT(within, 1000U);
    EXPECT_LT(heard_outside, 50U * 400U - within) << "something is not heard";
  }
}

// From the large cell of the countryside into the small ones of the village and back.
TEST(UnevenCells, AreJoinedBeforeABorderWithoutFlapping) {
  AreaOfInterestManager manager(with_tree(1), presence_of(1, 11));
  const Position near{880.0, 1000.0, 0.0};
  CellId last = manager.cells().cell({700.0, 1000.0, 0.0});
  nanoseconds now = seconds(1);
  std::size_t crossings = 0, unheard = 0, joins = 0;
  for (int turn = 0; turn < 20; ++turn) {
    for (int i = 0; i < 100; ++i, now += milliseconds(20)) {
      // Oscillates by 1 m at the village's edge, 4 times a second, and walks 500 m.
      const double x = 700.0 + 5.0 * i + std::sin(0.5 * i);
      const Focus focus{{turn % 2 == 0 ? x : 1900.0 - x, 1000.0, 0.0}, 25.0, 200.0};
      joins += manager.listen(kCellTier, {&focus, 1}, now).join.size();
      const CellId cell = manager.cells().cell(focus.position);
      crossings += cell != last;
      last = cell;
      unheard += !manager.subscriptions().hears(manager.route(focus.position));
      unheard += distance(focus.position, near) <= 200.0 &&
                 !manager.subscriptions().hears(manager.route(near));
    }
  }
  EXPECT_GE(crossings, 20U);
  EXPECT_EQ(unheard, 0U);
  RecordProperty("joins", static_cast<int>(joins));
}

TEST(UnevenCells, DoNotFlapAtABorder) {
  AreaOfInterestManager manager(with_tree(1), presence_of(1, 11));
  const Position middle = manager.cells().visit([](const auto& cells) { return cells.centre({}); });
  std::size_t changes = 0;
  for (int i = 0; i < 1000; ++i) {
    const Focus focus{{middle.x + (i % 2 == 0 ? 1.0 : -1.0), middle.y, 0.0}, 10.0, 200.0};
    const auto change = manager.listen(kCellTier, {&focus, 1}, milliseconds(100) * i);
    if (i > 1) changes += change.join.size() + change.leave.size();
  }
  EXPECT_EQ(changes, 0U);
}

TEST(UnevenCells, ConnectPeersOfTheSameTreeOnly) {
  const AreaOfInterestConfig how = with_tree(2);
  World world;
  world.add(presence_of(1, 11), {1000, 1000, 0}, how);
  world.add(presence_of(2, 22), {1100, 1000, 0}, how);
  world.add(presence_of(3, 33), {-1900, -1900, 0}, how);
  world.add(presence_of(4, 44), {1000, 1050, 0}, with_tree(3, 16));  // another tree
  world.run(milliseconds(200));
  world.let_speak(3);
  world.run(milliseconds(5));
  EXPECT_EQ(world.members[0].used, (std::vector<pdu::EntityId>{{7, 2, 1}}));
  EXPECT_EQ(world.members[1].used, (std::vector<pdu::EntityId>{{7, 1, 1}}));
  EXPECT_TRUE(world.members[2].used.empty());
  EXPECT_TRUE(world.members[3].used.empty());
  EXPECT_EQ(world.members[0].manager->presence().standing(22), Standing::member);
  EXPECT_EQ(world.members[0].manager->presence().standing(44), Standing::other_scene);
  EXPECT_EQ(world.members[0].manager->presence().own().cell_scheme, CellScheme::quad_tree);
}

TEST(UnevenCells, HaveContactGroupsBehindThePool) {
  AreaOfInterestConfig how = with_tree(4);
  how.tiers = {&kTouchKind};
  AreaOfInterestManager manager(how, presence_of(1, 11));
  const Focus hand{{1000, 1000, 0}, 0.0, 0.5};
  const auto change = manager.listen(manager.tiers().urgent().front(), {&hand, 1}, seconds(1));
  ASSERT_EQ(change.join.size(), 1U);
  EXPECT_EQ(change.join[0].value, manager.route(hand.position).value + 64);
  EXPECT_TRUE(manager.subscriptions().hears(change.join[0]));
}

TEST(UnevenCells, AreRefusedWhereGroupsAreTooFew) {
  AreaOfInterestConfig how = with_tree(5, 64);
  how.grid.pool = 32;
  EXPECT_THROW(AreaOfInterestManager(how, presence_of(1, 11)), std::invalid_argument);
  AreaOfInterestConfig plain = with_rooms();
  plain.interop = true;
  EXPECT_THROW(AreaOfInterestManager(plain, presence_of(1, 11)), std::invalid_argument);
  how.leader.on = how.leader.hand_out = true;
  EXPECT_NO_THROW(AreaOfInterestManager(how, presence_of(1, 11))) << "they are handed out";
}

TEST(UnevenCells, BlockReceptionThroughAWall) {
  World world;
  world.add(presence_of(1, 11), {90, 90, 0}, with_rooms());
  world.add(presence_of(2, 22), {110, 90, 0}, with_rooms());
  world.add(presence_of(3, 33), {90, 110, 0}, with_rooms());
  world.run(milliseconds(200));
  world.let_speak(3);
  world.run(milliseconds(5));
  EXPECT_EQ(world.members[0].used, (std::vector<pdu::EntityId>{{7, 2, 1}}));
  EXPECT_EQ(world.members[1].used, (std::vector<pdu::EntityId>{{7, 1, 1}}));
  EXPECT_TRUE(world.members[2].used.empty());
  EXPECT_EQ(world.members[0].manager->presence().own().cell_scheme, CellScheme::locales);
}

TEST(UnevenCells, HidePeersBehindAWallUntilTheDoor) {
  AreaOfInterestManager manager(with_rooms(), presence_of(1, 11));
  const Focus focus{{90, 90, 0}, 0.0, 50.0};
  manager.listen(kCellTier, {&focus, 1}, seconds(1));
  EXPECT_EQ(manager.sight().judge({110, 90, 0}, 0.0, 1, false), InterestVerdict::inside);
  EXPECT_LE(manager.sight().gap({110, 90, 0}, 0.0), 0.0);
  EXPECT_EQ(manager.sight().judge({90, 110, 0}, 0.0, 1, false), InterestVerdict::hidden);
  EXPECT_EQ(manager.sight().judge({90, 110, 0}, 0.0, 1, true), InterestVerdict::hidden);
  EXPECT_EQ(manager.sight().gap({90, 110, 0}, 0.0), Interest::kHiddenGap);
  EXPECT_EQ(manager.sight().interest().counts().hidden, 2U);
  EXPECT_EQ(manager.sight().judge({200, 90, 0}, 0.0, 1, false), InterestVerdict::outside);
}

TEST(UnevenCells, PeerInHundredsOfLocalesReceivesEach) {
  constexpr std::uint16_t kRooms = 400;
  std::vector<Locale> rooms;
  for (std::uint16_t i = 0; i < kRooms; ++i) rooms.push_back({{10.0 * i, 0, 0}, 0.0, 5, 5, {}});
  AreaOfInterestConfig how = config();
  how.grid.pool = kMaximumPool;
  how.cells.emplace(LocaleMap(rooms));
  AreaOfInterestManager manager(how, presence_of(1, 11));
  FocusCover cover(manager.cells());
  std::vector<Focus> ours;  // in every second room
  for (std::uint16_t i = 0; i < kRooms; i += 2) ours.push_back({{10.0 * i, 0, 0}, 0.0, 8.0});
  manager.listen(kCellTier, cover.cover(ours), seconds(0));
  EXPECT_EQ(manager.subscriptions().joined_groups(), kRooms / 2U);
  for (std::uint16_t i = 0; i < kRooms; ++i) {
    const Position there{10.0 * i + (i % 2 == 0 ? 1.0 : -4.0), 0, 0};
    const auto verdict = manager.sight().judge(there, 0.0, 1, false);
    ASSERT_EQ(verdict, i % 2 == 0 ? InterestVerdict::inside : InterestVerdict::hidden) << i;
  }
}

}  // namespace
}  // namespace reckon::aoim
