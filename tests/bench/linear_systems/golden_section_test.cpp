// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/linear_systems/golden_section.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace reckon::bench {
namespace {

TEST(GoldenSection, FindsAMaximumToItsPrecision) {
  for (const double top : {-0.999, -0.3, 0.0, 0.7, 1.999}) {
    int calls = 0;
    const Greatest found = greatest_between(-1, 2, 1e-6, [&](double x) {
      ++calls;
      return 5 - std::abs(x - top);
    });
    EXPECT_NEAR(found.at, top, 1e-6);
    EXPECT_NEAR(found.value, 5, 1e-6);
    EXPECT_LE(calls, 2 + std::ceil(std::log(3e6) / std::log(1.6180339887498949)));
  }
}

TEST(GoldenSection, EndsOnAConstantFunction) {
  const double none = -std::numeric_limits<double>::infinity();
  const auto flat = [](double) { return 3.0; };
  EXPECT_EQ(greatest_between(0, 1, 1e-9, flat).value, 3.0);
  EXPECT_EQ(greatest_between(0, 1, 1e-9, [&](double) { return none; }).value, none);
  EXPECT_NEAR(greatest_between(0, 1, 1e-9, [](double x) { return x; }).at, 1.0, 1e-9);
}

}  // namespace
}  // namespace reckon::bench
