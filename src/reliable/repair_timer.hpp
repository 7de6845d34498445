// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Random waits of peers that may all want to send the same message, so that mostly one does.
#pragma once

#include <chrono>
#include <cmath>
#include <cstdint>
#include <random>

namespace reckon::peer {

/// Draws from a truncated exponential distribution: few waits are short and most are near the
/// longest one, so that the first message suppresses the others, as in NORM.
class RepairTimer {
 public:
  /// Group size for which the distribution is made. In a smaller group the mean wait is longer than
  /// it has to be, in a larger one more peers send.
  static constexpr double kGroup = 64;

  explicit RepairTimer(std::uint64_t seed) : random_(seed) {}

  /// A wait from 0 to `longest`.
  [[nodiscard]] std::chrono::nanoseconds draw(std::chrono::nanoseconds longest) {
    const double lambda = std::log(kGroup) + 1;
    const double share = std::uniform_real_distribution<double>(0, 1)(random_);
    const double wait = std::log1p(share * std::expm1(lambda)) / lambda;
    return std::chrono::nanoseconds(
        static_cast<std::int64_t>(wait * static_cast<double>(longest.count())));
  }

 private:
  std::mt19937_64 random_;
};

}  // namespace reckon::peer
