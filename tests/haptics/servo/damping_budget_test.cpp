// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/servo/damping_budget.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <random>
#include <span>

namespace reckon::haptics {
namespace {

TEST(DampingBudget, NeverSpendsMoreThanThereIs) {
  std::mt19937 rng(5);
  std::uniform_real_distribution<double> u(0, 1);
  // Hands come and go: a claim that is not there holds nothing when it comes back.
  std::array<DampingClaim, kMaxRemoteHands> claims{};
  std::array<double, kMaxRemoteHands> shares{};
  std::size_t count = 0;
  for (int i = 0; i < 20000; ++i) {
    if (u(rng) < 0.05) {
      const auto next = static_cast<std::size_t>(u(rng) * (kMaxRemoteHands + 0.99));
      for (std::size_t k = count; k < next; ++k) claims[k] = {};
      count = next;
    }
    for (DampingClaim& c : claims) {
      if (u(rng) < 0.05) c.wanted = u(rng) < 0.2 ? 0 : u(rng) < 0.1 ? 1e300 : u(rng);
      c.touching = u(rng) < 0.5;
    }
    share_damping(std::span(claims.data(), count), 1.0, 0.01, std::span(shares.data(), count));
    double sum = 0;
    for (std::size_t k = 0; k < count; ++k) {
      EXPECT_GE(shares[k], 0.0);
      sum += shares[k];
      claims[k].held = shares[k];
    }
    ASSERT_LE(sum, 1.0 + 1e-12);
  }
}

TEST(DampingBudget, SharesEquallyWhatTheModestLeave) {
  const double all = std::numeric_limits<double>::infinity();
  const std::array<DampingClaim, 2> two{{{0.2}, {all}}};
  std::array<double, 2> shares{};
  share_damping(two, 1.0, 0.01, shares);
  EXPECT_DOUBLE_EQ(shares[0], 0.2);
  EXPECT_DOUBLE_EQ(shares[1], 0.8);

  std::array<DampingClaim, kMaxRemoteHands> full;
  full.fill({all});
  full[3].wanted = 0.001;
  std::array<double, kMaxRemoteHands> each{};
  share_damping(full, 1.0, 0.01, each);
  EXPECT_DOUBLE_EQ(each[3], 0.001);
  EXPECT_DOUBLE_EQ(each[31], 0.999 / (kMaxRemoteHands - 1));
}

}  // namespace
}  // namespace reckon::haptics
