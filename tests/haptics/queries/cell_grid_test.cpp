// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/queries/cell_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "reckon/tests/haptics/support/pair_oracles.hpp"
#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::haptics {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;
using test::drawn_point;
using test::uniform;

struct ByNumber {
  bool operator()(const BoxPair& one, const BoxPair& other) const {
    return one.first != other.first ? one.first < other.first : one.second < other.second;
  }
};

std::vector<BoxPair> sorted(std::span<const BoxPair> pairs) {
  std::vector<BoxPair> all(pairs.begin(), pairs.end());
  std::sort(all.begin(), all.end(), ByNumber{});
  return all;
}

/// Every pair compared, in the order of their lower x, so that ten thousand take less than a
/// minute.
std::vector<BoxPair> every_pair(const std::vector<AlignedBox3d>& boxes) {
  std::vector<std::uint32_t> order(boxes.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return boxes[a].min().x() < boxes[b].min().x();
  });
  std::vector<BoxPair> found;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const AlignedBox3d& a = boxes[order[i]];
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      const AlignedBox3d& b = boxes[order[j]];
      if (b.min().x() > a.max().x()) break;
      if (b.min().y() > a.max().y() || a.min().y() > b.max().y() || b.min().z() > a.max().z() ||
          a.min().z() > b.max().z())
        continue;
      found.push_back({std::min(order[i], order[j]), std::max(order[i], order[j])});
    }
  }
  std::sort(found.begin(), found.end(), ByNumber{});
  return found;
}

void place_all(CellGrid& grid, const std::vector<AlignedBox3d>& boxes) {
  for (std::uint32_t i = 0; i < boxes.size(); ++i) grid.place(i, boxes[i]);
}

std::vector<AlignedBox3d> drawn_boxes(std::mt19937_64& random, std::size_t count, double reach,
                                      double least, double most) {
  std::vector<AlignedBox3d> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    const double size = std::exp(uniform(random, std::log(least), std::log(most)));
    const Vector3d at = drawn_point(random, reach);
    const Vector3d half =
        0.5 * size *
        Vector3d(uniform(random, 0.2, 1.0), uniform(random, 0.2, 1.0), uniform(random, 0.2, 1.0));
    boxes.emplace_back(at - half, at + half);
  }
  return boxes;
}

void move_all(std::mt19937_64& random, std::vector<AlignedBox3d>& boxes, double way) {
  for (AlignedBox3d& box : boxes) box.translate(drawn_point(random, way));
}

TEST(CellGrid, FindsThePairsOfTenThousandMovingBoxes) {
  std::mt19937_64 random(1);
  std::vector<AlignedBox3d> boxes = drawn_boxes(random, 10'000, 5.0, 0.1, 0.3);
  CellGrid grid(boxes.size());
  const int steps = test::tries(30, 100);
  std::size_t all = 0;
  for (int step = 0; step < steps; ++step) {
    place_all(grid, boxes);
    const std::vector<BoxPair> expected = every_pair(boxes);
    ASSERT_EQ(sorted(grid.overlaps()), expected) << "step " << step;
    all += expected.size();
    move_all(random, boxes, 0.05);
  }
  EXPECT_GT(all, 500u * static_cast<unsigned>(steps));
}

TEST(CellGrid, FindsPairsOfVeryDifferentSizes) {
  std::mt19937_64 random(2);
  std::vector<AlignedBox3d> boxes = drawn_boxes(random, 1'000, 10.0, 0.01, 10.0);
  boxes.emplace_back(Vector3d::Constant(-1e9), Vector3d::Constant(1e9));
  boxes.emplace_back(Vector3d::Constant(-std::numeric_limits<double>::infinity()),
                     Vector3d(0, 1e30, 1e300));
  boxes.emplace_back(Vector3d::Zero(), Vector3d::Zero());
  boxes.emplace_back(Vector3d::Zero(), Vector3d::Zero());
  CellGrid grid;
  for (int step = 0; step < 50; ++step) {
    place_all(grid, boxes);
    ASSERT_EQ(sorted(grid.overlaps()), every_pair(boxes)) << "step " << step;
    for (std::size_t i = 0; i < 1'000; ++i) {
      if (random() % 3 == 0) continue;
      boxes[i].translate(drawn_point(random, 0.5));
      const double grown = uniform(random, -0.1, 0.1);
      if (boxes[i].sizes().minCoeff() > 0.3) boxes[i].max().array() += grown;
    }
  }
}

TEST(CellGrid, FindsTouchingBoxesAtCellBorders) {
  std::mt19937_64 random(3);
  const auto raster = [&](int most) {
    return std::uniform_int_distribution<int>(0, most)(random) / 4.0;
  };
  std::vector<AlignedBox3d> boxes;
  for (int i = 0; i < 600; ++i) {
    const Vector3d low(raster(40) - 5, raster(40) - 5, raster(40) - 5);
    boxes.emplace_back(low, low + Vector3d(raster(4), raster(4), raster(4)));
  }
  CellGrid grid;
  place_all(grid, boxes);
  EXPECT_EQ(sorted(grid.overlaps()), every_pair(boxes));
}

TEST(CellGrid, FindsBoxesFarFromTheOrigin) {
  std::mt19937_64 random(4);
  std::vector<AlignedBox3d> boxes = drawn_boxes(random, 500, 1.0, 0.01, 0.3);
  for (AlignedBox3d& box : boxes) box.translate(Vector3d(6.4e6, -6.4e6, 6.4e6));
  CellGrid grid;
  place_all(grid, boxes);
  EXPECT_EQ(sorted(grid.overlaps()), every_pair(boxes));
  boxes.assign(300, AlignedBox3d(Vector3d(1, 1, 1), Vector3d(2, 2, 2)));
  CellGrid heap;
  place_all(heap, boxes);
  EXPECT_EQ(heap.overlaps().size(), 300u * 299u / 2u);
  EXPECT_EQ(sorted(heap.overlaps()), every_pair(boxes));
}

TEST(CellGrid, ForgetsRemovedAndInvalidBoxes) {
  CellGrid grid;
  const AlignedBox3d box(Vector3d::Zero(), Vector3d::Ones());
  grid.place(3, box);
  grid.place(70, box);
  EXPECT_EQ(grid.size(), 2u);
  ASSERT_EQ(grid.overlaps().size(), 1u);
  EXPECT_EQ(grid.overlaps()[0], (BoxPair{3, 70}));
  grid.remove(3);
  grid.remove(3);
  grid.remove(5'000);
  EXPECT_EQ(grid.size(), 1u);
  EXPECT_TRUE(grid.overlaps().empty());
  grid.place(3, box);
  EXPECT_EQ(grid.overlaps().size(), 1u);
  grid.place(70, AlignedBox3d(Vector3d::Ones(), Vector3d::Zero()));
  EXPECT_TRUE(grid.overlaps().empty());
  grid.place(70, AlignedBox3d(Vector3d(0, std::nan(""), 0), Vector3d::Ones()));
  EXPECT_TRUE(grid.overlaps().empty());
  EXPECT_EQ(grid.size(), 1u);
}

// Against a search of all boxes, for small and large boxes, near and far.
TEST(CellGrid, VisitsTheIntersectingBoxes) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  const auto drawn = [&](double room) {
    const Vector3d at = room * Vector3d(any(random), any(random), any(random));
    const double half = std::pow(10.0, -2.0 + 2.0 * any(random));
    return AlignedBox3d(at - Vector3d::Constant(half), at + Vector3d::Constant(half));
  };
  CellGrid grid;
  std::vector<AlignedBox3d> boxes;
  for (int i = 0; i < 2000; ++i) {
    boxes.push_back(i % 500 == 0
                        ? AlignedBox3d(Vector3d::Constant(-1e300), Vector3d::Constant(1e15))
                        : drawn(i % 10 == 0 ? 1e6 : 2.0));
    grid.place(static_cast<std::uint32_t>(i), boxes.back());
  }
  for (int i = 0; i < 2000; i += 7) {
    grid.remove(static_cast<std::uint32_t>(i));
    boxes[static_cast<std::size_t>(i)].setEmpty();
  }
  std::size_t met = 0;
  for (int i = 0; i < 500; ++i) {
    const AlignedBox3d box = i == 0
                                 ? AlignedBox3d(Vector3d::Constant(-1e15), Vector3d::Constant(1e15))
                                 : drawn(i % 10 == 0 ? 1e6 : 2.0);
    std::vector<std::uint32_t> found, wanted;
    grid.visit(box, [&](std::uint32_t number) { found.push_back(number); });
    std::ranges::sort(found);
    for (std::uint32_t k = 0; k < boxes.size(); ++k)
      if (!boxes[k].isEmpty() && boxes[k].intersects(box)) wanted.push_back(k);
    ASSERT_EQ(found, wanted) << i;
    met += found.size();
  }
  EXPECT_GT(met, 5000U);
}

TEST(CellGrid, AllocatesNothingOnceItHasGrown) {
  std::mt19937_64 random(5);
  std::vector<AlignedBox3d> boxes = drawn_boxes(random, 2'000, 3.0, 0.02, 0.3);
  CellGrid grid;
  place_all(grid, boxes);
  static_cast<void>(grid.overlaps());
  for (AlignedBox3d& box : boxes) box.translate(Vector3d(100, 0, 0));
  const test::AllocationGuard guard;
  place_all(grid, boxes);
  static_cast<void>(grid.overlaps());
  for (std::uint32_t i = 0; i < 2'000; i += 2) grid.remove(i);
  static_cast<void>(grid.overlaps());
  place_all(grid, boxes);
  EXPECT_EQ(guard.count(), 0u);
}

}  // namespace
}  // namespace reckon::haptics
