// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The booked share of the springs' potential, and the strongest force if not all can be rendered.
#include "reckon/haptics/passivity/split.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;

// The cost of a split, by its definition.
double cost(const SplitBound& b, const Vector3d& wanted, double w) {
  const double rest = (wanted - w * b.springs).squaredNorm();
  return w * b.stored + (rest > 0 ? rest / (4 * (b.spare - w * b.half_slope)) : 0.0);
}

TEST(Split, BooksTheMostThatTheEnergyAllows) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> u(0, 1);
  const auto any = [&] { return Vector3d(u(random) - .5, u(random) - .5, u(random) - .5); };
  int whole = 0, part = 0, none = 0;
  for (int i = 0; i < 20'000; ++i) {
    SplitBound b;
    b.springs = 8 * u(random) * any();
    b.spare = 1000 * (0.1 + u(random));
    b.half_slope = u(random) < 0.1 ? 0 : 475 * u(random);
    b.stored = 0.01 * u(random);
    b.energy = 0.01 * u(random) * u(random);
    const Vector3d wanted = b.springs + (u(random) < 0.5 ? 0.0 : u(random)) * any();
    const auto w = largest_weight(b, wanted);
    double best = -1;  // by trying all of them
    for (int k = 0; k <= 2000; ++k) {
      const double there = k / 2000.0;
      if (0.999 * b.spare >= there * b.half_slope && cost(b, wanted, there) <= b.energy)
        best = there;
    }
    if (best >= 0) {
      ASSERT_TRUE(w.has_value()) << i;
      EXPECT_GE(*w, best - 1e-9) << i;
    }
    if (!w) {
      ++none;
      continue;
    }
    EXPECT_LE(*w, best < 0 ? 1.0 : best + 1.0 / 2000 + 1e-9);
    EXPECT_LE(cost(b, wanted, *w), b.energy * (1 + 1e-9) + 1e-15) << i;
    (*w < 1 ? part : whole) += 1;
  }
  EXPECT_GT(std::min({whole, part, none}), 1000) << whole << " " << part << " " << none;
}

TEST(Split, RendersTheMaximumWhenEnergyIsShort) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> u(0, 1);
  for (int i = 0; i < 5'000; ++i) {
    SplitBound b;
    b.springs = Vector3d(0.5 + 8 * u(random), 0, 0);
    b.spare = 1000;
    b.half_slope = 475 * u(random);
    b.stored = b.springs.squaredNorm() / (4 * std::max(50.0, b.half_slope));
    b.energy = b.stored * u(random) * 0.3;
    if (largest_weight(b, b.springs)) continue;
    const Strongest most = strongest(b).value_or(Strongest{});
    EXPECT_LE(cost(b, most.share * b.springs, most.weight), b.energy * (1 + 1e-6) + 1e-15);
    for (int k = 0; k <= 200; ++k) {
      const double w = k / 200.0, left = (b.spare - w * b.half_slope) * (b.energy - w * b.stored);
      if (b.energy < w * b.stored || b.spare < w * b.half_slope) break;
      EXPECT_GE(most.share * b.springs.x(), w * b.springs.x() + std::sqrt(4 * left) - 1e-3);
    }
  }
}

}  // namespace
}  // namespace reckon::haptics
