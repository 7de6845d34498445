// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How much more energy a liar puts into a resting hand than an honest hand with the motion that the
// liar shows.
#pragma once

#include <vector>

namespace reckon::fuzz {

inline constexpr double kSampled = 1e-3;  // [s], between two entries of a book

/// Energy beyond 1.5 times that of the honest hand in an equally long time, up to 0.1 s sooner or
/// later: springs take and return a multiple of the remainder, and no two runs are alike.
struct Excess {
  double power = 0;  ///< [W], most over any second
  double burst = 0;  ///< [J], most within any 50 ms
};

/// @param got, honest energy put into the hand so far [J], every kSampled
[[nodiscard]] Excess excess_over(const std::vector<double>& got, const std::vector<double>& honest);

}  // namespace reckon::fuzz
