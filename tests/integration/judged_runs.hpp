// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Judges runs of two hands at one body over lines with different delays, losses and seeds.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "reckon/tests/integration/two_peers_one_body.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::test {

/// Seeds of each line.
[[nodiscard]] inline int seeds() { return tries(1, 60); }

/// Expects at its end that 97 % of the runs pass.
class Share {
 public:
  Share() = default;
  Share(const Share&) = delete;
  Share& operator=(const Share&) = delete;
  ~Share() { EXPECT_LE(missed_, runs_ * 3 / 100) << "of " << runs_ << " runs:" << where_; }
  void note(bool is_kept, double delay, double loss, int seed) {
    ++runs_;
    if (is_kept) return;
    ++missed_;
    where_ += fmt::format("\n{} s, loss {}, seed {}", delay, loss, seed);
  }

 private:
  int runs_ = 0, missed_ = 0;
  std::string where_;
};
[[nodiscard]] inline haptics::HandTarget target_at(double x, double z = 0.0) {
  haptics::HandTarget target;
  target.position = {x, 0, z};
  return target;
}

inline void expect_one_owner(const OneBodyRun& run) {
  for (const OneBodyStep& step : run.steps()) ASSERT_LE(step.owners, 1);
}

}  // namespace reckon::test
