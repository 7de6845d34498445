// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How far off predictions were, for very many entities at once: percentiles from 600 octets. The
// rule of its buckets is that of peer::DurationHistogram; counts of 16 bits that are halved are its
// own, as the other's are atomic and take 9 KB.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace reckon::tools {

/// Distribution of sizes of any unit, 1e-5 to 1e6, in buckets 9 to 12.5 % wide (8 a power of two).
/// Where a bucket is full, at 65,535, all counts are halved: old values fade, the shape stays. One
/// thread, no allocation.
class JumpHistogram {
 public:
  /// Negative or NaN counts as 0, above the last bucket as its end. About 2 ns.
  void add(double size) noexcept;

  /// Values added.
  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
  /// The largest one added; 0 if none.
  [[nodiscard]] double max() const noexcept { return max_; }
  /// The smallest size with at least `share` (0 to 1) of all at or below it, rounded up by at most
  /// 12.5 %, and never above max(); sizes below 1e-5 give 0. 0 if none were added.
  [[nodiscard]] double percentile(double share) const noexcept;

 private:
  static constexpr std::size_t kBuckets = 8 * 38 + 1;
  static constexpr std::size_t kMerged = 7;       // buckets of the rule that share the first one
  static constexpr double kUnitsPerOne = 0x1p20;  // powers from 2^-17, 7.6e-6,
  static constexpr double kLargest = 0x1.ep20;    // to 2^21, 2.1e6: within the last bucket

  [[nodiscard]] static std::size_t bucket_of(double size) noexcept;
  [[nodiscard]] static double upper_end(std::size_t bucket) noexcept;
  void halve() noexcept;

  std::array<std::uint16_t, kBuckets> buckets_{};  // the first one holds what is below the least
  std::uint64_t count_ = 0;
  float max_ = 0;
};

}  // namespace reckon::tools
