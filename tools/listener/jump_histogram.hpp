// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Prediction errors of many entities at once: a histogram with percentiles in 600 octets.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "reckon/peer/counters/histogram.hpp"

namespace reckon::tools {

/// Values in any unit, 1e-5 to 1e6, in buckets 9 to 12.5 % wide (8 per power of two); one thread.
/// Negative values and NaN count as 0, values above the last bucket as its end; values below 1e-5
/// give 0.
struct JumpScale {
  using Value = double;
  using Kept = float;
  using Count = std::uint16_t;
  using Buckets = peer::LogLinear<3>;
  static constexpr std::size_t kBuckets = 8 * 38 + 1;
  static constexpr bool kShared = false;
  static constexpr std::size_t kMerged = 7;       ///< buckets of LogLinear that share the first one
  static constexpr double kUnitsPerOne = 0x1p20;  ///< powers from 2^-17, 7.6e-6,
  static constexpr double kLargest = 0x1.ep20;    ///< to 2^21, 2.1e6: within the last bucket

  static float keep(double size) noexcept {
    // The negated comparison catches NaN too.
    if (!(size > 0)) return 0;
    return static_cast<float>(std::min(size, double{std::numeric_limits<float>::max()}));
  }
  static double value_of(float kept) noexcept { return double{kept}; }
  static std::size_t bucket_of(float kept) noexcept {
    const double units = std::min(double{kept}, kLargest) * kUnitsPerOne;
    return std::max(Buckets::bucket_of(static_cast<std::uint64_t>(units)), kMerged) - kMerged;
  }
  static float last_of(std::size_t bucket) noexcept {
    if (bucket == 0) return 0;
    return static_cast<float>(static_cast<double>(Buckets::end_of(bucket + kMerged)) /
                              kUnitsPerOne);
  }
};
using JumpHistogram = peer::Histogram<JumpScale>;

}  // namespace reckon::tools
