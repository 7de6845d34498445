// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/cells/quad_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "reckon/aoim/interest/subscription.hpp"

namespace reckon::aoim::quad_tree_test {
namespace {

QuadTreeConfig square(std::size_t pool = 64) {
  QuadTreeConfig config;
  config.centre = {100.0, -50.0, 0.0};
  config.side = 1024.0;
  config.pool = pool;
  return config;
}

// Three quarters crowded in one corner, a quarter all over the square.
std::vector<Demand> crowd(std::uint64_t seed, std::size_t count = 600) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> all(-512.0, 512.0), corner(300.0, 400.0);
  std::vector<Demand> demands;
  for (std::size_t i = 0; i < count; ++i) {
    auto& place = i % 4 == 0 ? all : corner;
    const double x = 100.0 + place(random), y = -50.0 + place(random);
    demands.push_back({{x, y, 7.0}, 40.0, 0});
  }
  return demands;
}

TEST(QuadTree, IsOneCellUntilItIsDivided) {
  const QuadTree tree(square());
  EXPECT_EQ(tree.cells(), 1U);
  EXPECT_EQ(tree.group(Position{0, 0, 0}), GroupIndex{1});
  EXPECT_EQ(tree.group(Position{1e300, -1e300, 0}), GroupIndex{1});
}

TEST(QuadTree, GivesEachCellItsOwnGroup) {
  for (const std::size_t pool : {1U, 4U, 5U, 64U, 256U}) {
    const QuadTree tree = QuadTree::divided_by(square(pool), crowd(1));
    std::set<std::uint16_t> groups;
    for (std::uint16_t g = 1; g <= tree.cells(); ++g) {
      const CellId cell = tree.cell_of({g});
      EXPECT_EQ(tree.group(cell), GroupIndex{g});
      EXPECT_EQ(tree.cell(tree.centre(cell)), cell);
      groups.insert(tree.group(tree.centre(cell)).value);
    }
    EXPECT_EQ(groups.size(), tree.cells());
    EXPECT_LE(tree.cells(), pool);
    EXPECT_GT(tree.cells() + 3, pool) << "pool " << pool;
  }
}

TEST(QuadTree, DividesCrowdedAreasMost) {
  const QuadTree tree = QuadTree::divided_by(square(), crowd(2));
  const int in_crowd = tree.cell({450.0, 300.0, 0.0}).r, far = tree.cell({-300.0, -450.0, 0.0}).r;
  EXPECT_GT(in_crowd, far + 1);
}

TEST(QuadTree, StopsAtItsDepthOrWithoutGain) {
  QuadTreeConfig config = square();
  config.depth = 2;
  const QuadTree shallow = QuadTree::divided_by(config, crowd(3));
  for (std::uint16_t g = 1; g <= shallow.cells(); ++g) EXPECT_LE(shallow.cell_of({g}).r, 2);
  EXPECT_EQ(QuadTree::divided_by(square(), {}).cells(), 1U);
}

TEST(QuadTree, FindsAllCellsThatADiscMeets) {
  const QuadTree tree = QuadTree::divided_by(square(), crowd(4));
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> place(-700.0, 900.0), size(0.0, 200.0);
  for (int i = 0; i < 2000; ++i) {
    const Position p{place(random), place(random), 0.0};
    const double radius = size(random);
    std::set<CellId> found, expected;
    tree.for_each_cell_within(p, radius, [&](CellId cell, double) { found.insert(cell); });
    for (std::uint16_t g = 1; g <= tree.cells(); ++g) {
      if (tree.distance(tree.cell_of({g}), p) <= radius) expected.insert(tree.cell_of({g}));
    }
    EXPECT_EQ(found, expected);
    EXPECT_TRUE(found.count(tree.cell(p))) << "its own cell is at distance 0";
  }
}

// Peers outside the square still receive nearby senders.
TEST(QuadTree, ReachesAllSendersWithinTheRadius) {
  const QuadTree tree = QuadTree::divided_by(square(), crowd(6));
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> place(-900.0, 1100.0), turn(0.0, 6.28), share(0.0, 1.0);
  for (int i = 0; i < 5000; ++i) {
    const Position listener{place(random), place(random), 0.0};
    const double away = 100.0 * share(random), angle = turn(random);
    const Position sender{listener.x + away * std::cos(angle), listener.y + away * std::sin(angle),
                          0};
    bool heard = false;
    tree.for_each_cell_within(listener, 100.0 + 1e-9, [&](CellId cell, double) {
      heard = heard || tree.group(cell) == tree.group(sender);
    });
    EXPECT_TRUE(heard) << listener.x << " " << listener.y << " hears " << sender.x << " "
                       << sender.y;
  }
}

TEST(QuadTree, NamesAGroupForCellsOfAnotherTree) {
  const QuadTree fine = QuadTree::divided_by(square(256), crowd(8));
  const QuadTree coarse = QuadTree::divided_by(square(16), crowd(8));
  for (std::uint16_t g = 1; g <= fine.cells(); ++g) {
    const CellId cell = fine.cell_of({g});
    EXPECT_EQ(coarse.group(cell), coarse.group(fine.centre(cell)));
  }
  EXPECT_GE(fine.group(CellId{0, 0}).value, 1);
  EXPECT_LE(fine.group(CellId{-7, 99}).value, 256);
}

std::vector<CellId> cells_of(const QuadTree& tree) {
  return {tree.leaves().begin(), tree.leaves().end()};
}

// Peers that read the same demands, and peers that receive the list of cells, have the same groups.
TEST(QuadTree, IsIndependentOfTheOrderOfItsInput) {
  std::vector<Demand> demands = crowd(10);
  for (std::size_t i = 0; i < demands.size(); ++i)
    demands[i].instant = static_cast<std::uint32_t>(i % 3);
  const QuadTree tree = QuadTree::divided_by(square(100), demands);
  std::mt19937_64 random(11);
  for (int turn = 0; turn < 5; ++turn) {
    std::shuffle(demands.begin(), demands.end(), random);
    EXPECT_EQ(cells_of(QuadTree::divided_by(square(100), demands)), cells_of(tree));
    std::vector<CellId> cells = cells_of(tree);
    std::shuffle(cells.begin(), cells.end(), random);
    EXPECT_EQ(cells_of(QuadTree::of_cells(square(100), cells)), cells_of(tree));
  }
  for (std::uint16_t g = 1; g <= tree.cells(); ++g)
    EXPECT_EQ(tree.group(tree.centre(tree.cell_of({g}))), GroupIndex{g});
}

TEST(QuadTree, IsCompletedAroundTheCellsThatAreNamed) {
  const CellId deep = QuadTree::cell_at("133").value();
  const QuadTree tree = QuadTree::of_cells(square(), {&deep, 1});
  EXPECT_EQ(tree.cells(), 10U);  // three subdivisions
  EXPECT_EQ(tree.cell({100.0 + 511, -50.0 - 1, 0}), deep) << "south-east, then north-east twice";
  EXPECT_EQ(tree.finest(), 128.0);
  std::set<std::string> paths;
  for (const CellId leaf : tree.leaves()) paths.insert(QuadTree::path_of(leaf));
  EXPECT_EQ(paths,
            (std::set<std::string>{"0", "10", "11", "12", "130", "131", "132", "133", "2", "3"}));
  EXPECT_EQ(QuadTree::of_cells(square(), {}).cells(), 1U);
}

TEST(QuadTree, RefusesCellsThatAreNoTree) {
  const auto refuses = [](std::vector<CellId> cells, std::size_t pool = 64) {
    QuadTreeConfig config = square(pool);
    config.depth = 4;
    EXPECT_THROW(QuadTree::of_cells(config, cells), std::invalid_argument);
  };
  refuses({{4, 1}});
  refuses({{-1, 1}});
  refuses({{0, 5}});
  refuses({{0, -1}});
  refuses({{0, 1}, {1, 2}});  // the second is inside the first
  refuses({{0, 3}}, 9);
  EXPECT_FALSE(QuadTree::cell_at("014"));
  EXPECT_FALSE(QuadTree::cell_at("0123012301230123"));
  EXPECT_EQ(QuadTree::cell_at(""), (CellId{0, 0}));
}

TEST(QuadTree, BoundsTheGroupsThatADiscReaches) {
  for (const std::uint64_t seed : {12U, 13U, 14U}) {
    const QuadTree tree = QuadTree::divided_by(square(128), crowd(seed));
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> place(-600.0, 700.0), corner(350.0, 550.0);
    for (const double radius : {0.0, 1.0, 40.0, 300.0, 3000.0}) {
      const std::size_t bound = tree.groups_bound(radius);
      std::size_t most = 0;
      for (int i = 0; i < 20'000; ++i) {
        auto& along = i % 2 == 0 ? place : corner;
        std::size_t count = 0;
        tree.for_each_cell_within({along(random), along(random), 0}, radius,
                                  [&](CellId, double) { ++count; });
        most = std::max(most, count);
      }
      EXPECT_GE(bound, most);
      EXPECT_LE(bound, most + most / 8 + 3) << "radius " << radius;
    }
  }
}

TEST(QuadTree, RefusesParametersOutOfRange) {
  QuadTreeConfig config = square();
  config.side = 0.0;
  EXPECT_THROW(QuadTree{config}, std::invalid_argument);
  config = square();
  config.centre.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(QuadTree{config}, std::invalid_argument);
  config = square();
  config.depth = 16;
  EXPECT_THROW(QuadTree{config}, std::invalid_argument);
  EXPECT_THROW(QuadTree{square(0)}, std::invalid_argument);
  EXPECT_THROW(QuadTree{square(1001)}, std::invalid_argument);
}

TEST(QuadTree, IsSubscribedToLikeAGrid) {
  const QuadTree tree = QuadTree::divided_by(square(), crowd(9));
  Subscription subscription(tree, {});
  const Focus focus{{450.0, 300.0, 0.0}, 0.0, 40.0};
  subscription.update({&focus, 1}, std::chrono::seconds(0));
  std::set<std::uint16_t> expected;
  tree.for_each_cell_within(focus.position, 40.0,
                            [&](CellId cell, double) { expected.insert(tree.group(cell).value); });
  std::set<std::uint16_t> joined;
  for (const GroupIndex group : subscription.joined()) joined.insert(group.value);
  EXPECT_EQ(joined, expected);
}

}  // namespace
}  // namespace reckon::aoim::quad_tree_test
