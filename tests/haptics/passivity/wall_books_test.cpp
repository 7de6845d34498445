// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/passivity/wall_books.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace reckon::haptics {
namespace {

class Walls {
 public:
  explicit Walls(unsigned seed) : random_(seed) {}
  double within(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random_);
  }
  SpringWall any() {
    if (within(0, 1) < 0.1) return {};
    return {within(-0.1, 0.1), within(10, 2000), within(0.1, 20)};
  }
  WallSide side() { return within(0, 1) < 0.5 ? WallSide::below : WallSide::above; }

 private:
  std::mt19937 random_;
};

TEST(SpringWall, ForceIsTheSlopeOfStoredEnergy) {
  Walls walls(1);
  constexpr double kStep = 1e-7;
  for (int i = 0; i < 5000; ++i) {
    const SpringWall wall = walls.any();
    const WallSide side = walls.side();
    const double x = walls.within(-0.1, 0.1);
    const double slope =
        (stored_in(wall, side, x + kStep) - stored_in(wall, side, x - kStep)) / (2 * kStep);
    EXPECT_NEAR(force_of(wall, side, x), -slope, 2e-3);  // 2,000 N/m over half a step, and rounding
    EXPECT_LE(std::abs(force_of(wall, side, x)), wall.most);
  }
}

TEST(SpringWall, WorstRiseIsTheGreatestOfAllPositions) {
  Walls walls(2);
  for (int i = 0; i < 2000; ++i) {
    const SpringWall old = walls.any(), next = walls.any();
    const WallSide side = walls.side();
    const double at = walls.within(-0.1, 0.1), reach = walls.within(0, 0.05);
    const double worst = worst_rise(old, next, side, {at - reach, at + reach});
    double found = -1e9;
    for (int k = 0; k <= 400; ++k) {
      const double x = at + reach * (k / 200.0 - 1);
      found = std::max(found, stored_in(next, side, x) - stored_in(old, side, x));
    }
    EXPECT_GE(worst, found - 1e-12);
    EXPECT_LE(worst, found + 2e-4);  // 40 N over half a step of 0.25 mm: at most 5 mJ at kinks
  }
}

// A change that arrived later than assumed cost more than there was.
TEST(WallBooks, InDebtOnlyFreeChangesAreGranted) {
  WallBooks books;
  const SpringWall wall{0.0, 1000, 10};
  books.book(0, WallSide::below, wall, {-0.002, 0.01});
  const double owed = 0.5 * 1000 * 0.002 * 0.002;
  EXPECT_NEAR(books.energy(), -owed, 1e-12);
  // In front of the hand a stiffer one costs nothing; at a possible position of the hand it begins
  // deeper.
  const SpringWall stiffer{0.0, 2000, 10};
  EXPECT_EQ(books.payable(0, WallSide::below, stiffer, {0.001, 0.01}).at, 0.0);
  EXPECT_NEAR(books.payable(0, WallSide::below, stiffer, {-0.003, 0.01}).at,
              0.003 / std::sqrt(2.0) - 0.003, 1e-9);
  // Removed while the hand is certainly inside, it pays back its stored energy.
  books.book(0, WallSide::below, {}, {-0.004, -0.003});
  EXPECT_NEAR(books.energy(), 0.5 * 1000 * 0.003 * 0.003 - owed, 1e-12);
}

// The handle jumps, so each change finds it at the worst of its possible positions.
TEST(WallBooks, BooksAtMostTheHandsInput) {
  double most_paid = 0;
  for (unsigned seed = 1; seed <= 100; ++seed) {
    Walls walls(seed);
    WallBooks books;
    SpringModel shown;
    double put_in = 0, x = 0;
    const auto move = [&](double to) {
      for (const WallSide side : {WallSide::below, WallSide::above})
        put_in +=
            stored_in(shown.wall(0, side), side, to) - stored_in(shown.wall(0, side), side, x);
      x = to;
    };
    for (int i = 0; i < 500; ++i) {
      move(walls.within(-0.1, 0.1));
      const WallSide side = walls.side();
      const PlaceRange places{x - 0.01, x + 0.01};
      const SpringWall wall = books.payable(0, side, walls.any(), places);
      books.book(0, side, wall, places);
      move(x + walls.within(-0.01, 0.01));  // until the change has arrived at the device
      shown.wall(0, side) = wall;
      double stored = 0;
      for (const WallSide one : {WallSide::below, WallSide::above})
        stored += stored_in(shown.wall(0, one), one, x);
      ASSERT_LE(books.energy() + stored, put_in + 1e-9) << "seed " << seed << ", change " << i;
      ASSERT_GE(books.energy(), -1e-12);
      ASSERT_LE(books.energy(), WallBooks::kMost);
      most_paid = std::max(most_paid, stored);
    }
  }
  EXPECT_GT(most_paid, 0.01) << "no wall was ever pressed";
}

TEST(WallBooks, FreeWallIsRenderedAsRequested) {
  const WallBooks books;
  const SpringWall wall{-0.05, 1000, 10};
  EXPECT_EQ(books.payable(0, WallSide::below, wall, {-0.02, 0.02}), wall);
  EXPECT_EQ(books.payable(0, WallSide::below, wall, {-0.05, 0.02}), wall);
}

TEST(WallBooks, WallAroundTheHandBeginsOutsideItsRange) {
  const WallBooks books;
  const SpringWall shown = books.payable(0, WallSide::below, {0.05, 1000, 10}, {-0.02, 0.02});
  EXPECT_NEAR(shown.at, -0.02, 1e-9);
  EXPECT_LE(shown.at, -0.02 + 1e-12);
}

TEST(WallBooks, ReleasedEnergyPaysForTheNextWall) {
  WallBooks books;
  const SpringWall wall{0.0, 1000, 100};
  books.book(0, WallSide::below, wall, {0.01, 0.02});
  books.book(0, WallSide::below, {}, {-0.006, -0.005});
  EXPECT_NEAR(books.energy(), 0.5 * 1000 * 0.005 * 0.005, 1e-12);  // at the least depth
  EXPECT_EQ(books.payable(1, WallSide::above, {0.0, 1000, 100}, {-1, 0.0049}).at, 0.0);
  EXPECT_GT(books.payable(1, WallSide::above, {0.0, 1000, 100}, {-1, 0.0051}).at, 0.0);
}

TEST(WallBooks, PossiblyEndedEffectsArePaidAgain) {
  WallBooks books;
  const SpringWall wall{0.0, 1000, 100};
  books.book(0, WallSide::below, wall, {0.01, 0.02});
  EXPECT_EQ(books.payable(0, WallSide::below, wall, {-0.01, 0.01}), wall);
  books.forget();
  EXPECT_NEAR(books.payable(0, WallSide::below, wall, {-0.01, 0.01}).at, -0.01, 1e-9);
}

}  // namespace
}  // namespace reckon::haptics
