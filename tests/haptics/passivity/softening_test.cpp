// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/passivity/softening.hpp"

#include <gtest/gtest.h>

namespace reckon::haptics {
namespace {

constexpr double kStep = 1e-3;  // [s]

void run(Softening& softening, double seconds, double held, bool to_spare, bool touching = true) {
  for (double t = 0; t < seconds; t += kStep) softening.learn(held, to_spare, touching, kStep);
}

TEST(Softening, IgnoresShortShortages) {
  Softening softening;
  run(softening, 0.01, 0.5, false);
  EXPECT_GT(softening.share(), 0.999);
  run(softening, 1.0, 0.99, false);  // not noticeable
  EXPECT_GT(softening.share(), 0.98);
}

TEST(Softening, FallsToItsLeastWhileForceIsLimited) {
  Softening softening;
  run(softening, 0.5, 0.8, false);
  EXPECT_LT(softening.share(), 0.85);
  EXPECT_GT(softening.share(), 0.7);
  run(softening, 10.0, 0.0, false);
  EXPECT_EQ(softening.share(), Softening::kLeast);
}

TEST(Softening, RisesWithSpareEnergyAndOnRelease) {
  Softening softening;
  run(softening, 10.0, 0.0, false);
  run(softening, 0.5, 1.0, false);
  EXPECT_EQ(softening.share(), Softening::kLeast) << "just enough is not to spare";
  run(softening, 1.0, 1.0, true);
  EXPECT_NEAR(softening.share(), Softening::kLeast + 0.3, 0.01);
  run(softening, 0.6, 1.0, false, false);
  EXPECT_EQ(softening.share(), 1.0);
}

}  // namespace
}  // namespace reckon::haptics
