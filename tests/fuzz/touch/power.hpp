// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How much more a liar puts into a resting hand than an honest hand that moves as the liar says.
#pragma once

#include <vector>

namespace reckon::fuzz {

inline constexpr double kSampled = 1e-3;  // [s], between two entries of a book

/// Beyond half as much again as the honest one did in as long a time, up to 0.1 s sooner or later:
/// springs take and give a multiple of what is left over, and no two runs are alike.
struct Excess {
  double power = 0;  ///< [W], most over any second
  double burst = 0;  ///< [J], most within any 50 ms
};

/// @param got, honest what was put into the hand until then [J], every kSampled
[[nodiscard]] Excess excess_over(const std::vector<double>& got, const std::vector<double>& honest);

}  // namespace reckon::fuzz
