// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The rule for the buckets of all histograms: equal steps within each power of two. Also the search
// for a percentile.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace reckon::peer {

/// Buckets of whole numbers: one for each number below 2^sub_bits, above that 2^sub_bits for each
/// power of two.
template <unsigned sub_bits>
struct LogLinear {
  static constexpr std::uint64_t kSub = std::uint64_t{1} << sub_bits;

  [[nodiscard]] static constexpr std::size_t bucket_of(std::uint64_t value) noexcept {
    if (value < kSub) return static_cast<std::size_t>(value);
    const unsigned shift = static_cast<unsigned>(std::bit_width(value)) - 1 - sub_bits;
    return static_cast<std::size_t>(shift * kSub + (value >> shift));
  }
  /// The least number above the bucket. Valid up to the bucket of 2^63 - 1.
  [[nodiscard]] static constexpr std::uint64_t end_of(std::size_t bucket) noexcept {
    if (bucket < kSub) return bucket + 1;
    const std::uint64_t shift = bucket / kSub - 1;
    return (bucket - shift * kSub + 1) << shift;
  }
};

/// The first bucket that together with all lower ones contains at least `share` (0 to 1) of `all`
/// values, that is index ceil(share all) - 1 of a sorted list; `buckets` if their counts are fewer
/// than that.
/// @param count_of(bucket) number of its values
[[nodiscard]] std::size_t bucket_of_share(std::size_t buckets, std::uint64_t all, double share,
                                          auto&& count_of) noexcept {
  const double clamped = std::clamp(share, 0.0, 1.0);
  const auto rank = std::max<std::uint64_t>(
      static_cast<std::uint64_t>(std::ceil(clamped * static_cast<double>(all))), 1);
  std::uint64_t below = 0;
  for (std::size_t bucket = 0; bucket < buckets; ++bucket) {
    below += count_of(bucket);
    if (below >= rank) return bucket;
  }
  return buckets;
}

}  // namespace reckon::peer
