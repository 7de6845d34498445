// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/cells/cell_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <random>
#include <set>
#include <vector>

namespace reckon::aoim {
namespace {

constexpr double kPi = std::numbers::pi;

GridConfig grid_config(CellScheme scheme, double size = 100.0, std::size_t pool = 256) {
  GridConfig config;
  config.scheme = scheme;
  config.cell_size = size;
  config.pool = pool;
  return config;
}

// Corners of a cell, computed only from its centre and the definition of its side.
std::vector<Position> corners(const CellGrid& grid, CellId cell) {
  const Position middle = grid.centre(cell);
  const bool square = grid.config().scheme == CellScheme::square;
  const double side = grid.config().cell_size;
  const int count = square ? 4 : 6;
  const double reach = square ? side / std::sqrt(2.0) : side;
  std::vector<Position> result;
  for (int i = 0; i < count; ++i) {
    const double angle = square ? kPi * (0.25 + 0.5 * i) : kPi * (1.0 / 6.0 + i / 3.0);
    result.push_back({middle.x + reach * std::cos(angle), middle.y + reach * std::sin(angle), 0.0});
  }
  return result;
}

double distance_to_segment(const Position& p, const Position& a, const Position& b) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double t = ((p.x - a.x) * dx + (p.y - a.y) * dy) / (dx * dx + dy * dy);
  const double along = std::clamp(t, 0.0, 1.0);
  return std::hypot(p.x - a.x - along * dx, p.y - a.y - along * dy);
}

double distance_to_polygon(const Position& p, const std::vector<Position>& polygon) {
  bool inside = true;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Position &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    inside = inside && (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) >= 0.0;
    nearest = std::min(nearest, distance_to_segment(p, a, b));
  }
  return inside ? 0.0 : nearest;
}

class CellGridOfScheme : public ::testing::TestWithParam<CellScheme> {};

TEST_P(CellGridOfScheme, PutsEachPointIntoItsContainingCell) {
  const CellGrid grid(grid_config(GetParam()));
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> where(-5000.0, 5000.0);
  for (int i = 0; i < 20000; ++i) {
    const Position p{where(random), where(random), where(random)};
    const CellId cell = grid.cell(p);
    ASSERT_LE(distance_to_polygon(p, corners(grid, cell)), 1e-9) << p.x << ", " << p.y;
  }
}

TEST_P(CellGridOfScheme, GivesDistanceToNearestPointOfACell) {
  const CellGrid grid(grid_config(GetParam()));
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> where(-400.0, 400.0);
  for (int i = 0; i < 20000; ++i) {
    const Position p{where(random), where(random), 0.0};
    const CellId cell{static_cast<int>(random() % 5) - 2, static_cast<int>(random() % 5) - 2};
    ASSERT_NEAR(grid.distance(cell, p), distance_to_polygon(p, corners(grid, cell)), 1e-9);
  }
}

TEST_P(CellGridOfScheme, FindsTheCellsWithinARadius) {
  const CellGrid grid(grid_config(GetParam()));
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> where(-300.0, 300.0), radii(0.0, 350.0);
  for (int i = 0; i < 200; ++i) {
    const Position p{where(random), where(random), 0.0};
    const double radius = radii(random);
    std::set<CellId> expected, found;
    for (int q = -15; q <= 15; ++q) {
      for (int r = -15; r <= 15; ++r) {
        if (distance_to_polygon(p, corners(grid, {q, r})) <= radius) expected.insert({q, r});
      }
    }
    grid.for_each_cell_within(p, radius, [&](CellId cell, double away) {
      EXPECT_LE(away, radius);
      EXPECT_TRUE(found.insert(cell).second) << "a cell was visited twice";
    });
    ASSERT_EQ(found, expected) << "at " << p.x << ", " << p.y << " radius " << radius;
    ASSERT_LE(static_cast<double>(found.size()), grid.cells_bound(radius));
  }
}

TEST_P(CellGridOfScheme, NamesAsNeighboursExactlyTheCellsThatTouch) {
  const CellGrid grid(grid_config(GetParam()));
  for (const CellId cell : {CellId{0, 0}, CellId{-3, 4}, CellId{7, -9}}) {
    std::set<CellId> expected;
    for (int q = cell.q - 3; q <= cell.q + 3; ++q) {
      for (int r = cell.r - 3; r <= cell.r + 3; ++r) {
        double gap = std::numeric_limits<double>::infinity();
        for (const Position& corner : corners(grid, cell)) {
          gap = std::min(gap, distance_to_polygon(corner, corners(grid, {q, r})));
        }
        if (gap < 1e-9 && CellId{q, r} != cell) expected.insert({q, r});
      }
    }
    const Neighbours neighbours = grid.neighbours(cell);
    EXPECT_EQ(std::set<CellId>(neighbours.begin(), neighbours.end()), expected);
    EXPECT_EQ(neighbours.size(), GetParam() == CellScheme::square ? 8u : 6u);
  }
}

TEST_P(CellGridOfScheme, NeighboursNeverShareAGroupForAnyPool) {
  std::mt19937_64 random(4);
  std::uniform_int_distribution<int> where(-100000, 100000);
  for (std::size_t pool = 4; pool <= 1000; pool = pool < 70 ? pool + 1 : pool + 37) {
    const CellGrid grid(grid_config(GetParam(), 100.0, pool));
    std::set<GroupIndex> used;
    for (int i = 0; i < 2000; ++i) {
      const CellId cell{where(random), where(random)};
      const GroupIndex group = grid.group(cell);
      used.insert(group);
      ASSERT_GE(group.value, 1u);
      ASSERT_LE(group.value, pool);
      for (const CellId other : grid.neighbours(cell)) ASSERT_NE(grid.group(other), group) << pool;
    }
    // The tile wastes little of the pool.
    EXPECT_GE(grid.tile_columns() * grid.tile_rows() * 10, pool * 8) << pool;
  }
}

TEST_P(CellGridOfScheme, StaysInRangeForAnyCoordinates) {
  const CellGrid grid(grid_config(GetParam(), 1e-3));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  for (const Position& p :
       {Position{1e300, -1e300, 0}, Position{nan, inf, 0}, Position{-inf, nan, 0}}) {
    const GroupIndex group = grid.group(p);
    EXPECT_GE(group.value, 1u);
    EXPECT_LE(group.value, 256u);
    EXPECT_GT(grid.neighbours(grid.cell(p)).size(), 0u);
  }
}

INSTANTIATE_TEST_SUITE_P(Schemes, CellGridOfScheme,
                         ::testing::Values(CellScheme::square, CellScheme::hexagonal),
                         [](const auto& param_info) {
                           return param_info.param == CellScheme::square ? "square" : "hexagonal";
                         });

TEST_P(CellGridOfScheme, BoundsTheGroupsOfADiscAnywhere) {
  std::mt19937_64 random(23);
  for (const std::size_t pool : {1u, 4u, 16u, 256u, 997u, 1000u}) {
    const CellGrid grid(grid_config(GetParam(), 2.0, pool));
    for (const double radius : {0.0, 0.01, 1.0, 3.0, 7.7, 20.0}) {
      std::size_t most = 0;
      for (int i = 0; i < 400; ++i) {
        std::set<GroupIndex> groups;
        const Position at{std::uniform_real_distribution<double>(-30, 30)(random),
                          std::uniform_real_distribution<double>(-30, 30)(random), 0.0};
        grid.for_each_cell_within(at, radius,
                                  [&](CellId cell, double) { groups.insert(grid.group(cell)); });
        most = std::max(most, groups.size());
      }
      EXPECT_GE(grid.groups_bound(radius), most) << pool << ' ' << radius;
      EXPECT_LE(static_cast<double>(grid.groups_bound(radius)),
                1.15 * static_cast<double>(most) + 4)
          << pool << ' ' << radius;
    }
    const std::size_t all = grid.tile_columns() * grid.tile_rows();
    EXPECT_EQ(grid.groups_bound(1e6), all);
    EXPECT_EQ(grid.groups_bound(std::numeric_limits<double>::infinity()), all);
  }
}

TEST(CellGrid, HexagonNeighboursAreAllAtTheSameDistance) {
  const CellGrid grid(grid_config(CellScheme::hexagonal, 100.0));
  for (const CellId other : grid.neighbours({2, -5})) {
    EXPECT_NEAR(distance(grid.centre({2, -5}), grid.centre(other)), 100.0 * std::sqrt(3.0), 1e-9);
  }
}

TEST(CellGrid, RefusesSizesAndPoolsThatCannotWork) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double size : {0.0, -1.0, nan, std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(CellGrid(grid_config(CellScheme::square, size)), std::invalid_argument);
  }
  for (const std::size_t pool : {0u, 2u, 3u, 1001u}) {
    EXPECT_THROW(CellGrid(grid_config(CellScheme::square, 1.0, pool)), std::invalid_argument);
  }
  EXPECT_THROW(CellGrid(grid_config(CellScheme::none)), std::invalid_argument);
  EXPECT_EQ(CellGrid(grid_config(CellScheme::square, 1.0, 1)).group(CellId{5, 6}).value, 1u);
}

}  // namespace
}  // namespace reckon::aoim
