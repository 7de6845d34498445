// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/passivity/rate_limit.hpp"

#include <gtest/gtest.h>

#include <random>

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;

// The definition, by trying every fall of `held`.
double nearest_fall(const Vector3d& held, const Vector3d& wanted) {
  double least = wanted.norm();
  for (int i = 0; i <= 2000; ++i) least = std::min(least, (wanted - i / 2000.0 * held).norm());
  return least;
}

TEST(RateLimit, LimitsGrowthAndTurningButNotAFall) {
  const Vector3d held(2, 0, 0);
  EXPECT_EQ(nearest_in_reach(held, Vector3d(0.1, 0, 0), 0.5), Vector3d(0.1, 0, 0));
  const Vector3d none = Vector3d::Zero();
  EXPECT_EQ(nearest_in_reach(held, none, 0), none);
  EXPECT_EQ(nearest_in_reach(held, Vector3d(5, 0, 0), 0.5), Vector3d(2.5, 0, 0));
  EXPECT_EQ(nearest_in_reach(held, Vector3d(0, 3, 0), 0.5), Vector3d(0, 0.5, 0));
  EXPECT_EQ(nearest_in_reach(held, Vector3d(-3, 0, 0), 0.5), Vector3d(-0.5, 0, 0));
  EXPECT_EQ(nearest_in_reach(none, Vector3d(0, 0, 9), 0.5), Vector3d(0, 0, 0.5));
  EXPECT_EQ(part_in_reach(held, Vector3d(1, 0.2, 0), 0.5), 1.0);
  EXPECT_NEAR(part_in_reach(held, Vector3d(0, 4, 0), 0.5), 0.125, 1e-8);
}

TEST(RateLimit, EqualsTheDefinitionForRandomForces) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto force = [&] { return Vector3d(3 * unit(random), 3 * unit(random), 3 * unit(random)); };
  for (int i = 0; i < 3000; ++i) {
    const Vector3d held = force(), wanted = force();
    const double most = 0.5 + 0.5 * unit(random);
    const Vector3d near_by = nearest_in_reach(held, wanted, most);
    // The grid of falls has steps of at most 3 mN.
    EXPECT_LE(nearest_fall(held, near_by), most + 3e-3);
    EXPECT_EQ(within_reach(held, wanted, most), near_by == wanted);
    if (nearest_fall(held, wanted) > most + 3e-3) {
      EXPECT_NEAR((wanted - near_by).norm(), nearest_fall(held, wanted) - most, 3e-3);
    }
    const double part = part_in_reach(held, wanted, most);
    EXPECT_LE(nearest_fall(held, part * wanted), most + 3e-3);
    if (part < 1) {
      EXPECT_GE(nearest_fall(held, (part + 0.01) * wanted), most - 1e-6);
    }
  }
}

}  // namespace
}  // namespace reckon::haptics
