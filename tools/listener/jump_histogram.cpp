// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/listener/jump_histogram.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

namespace reckon::tools {
namespace {

constexpr unsigned kMantissaBits = 23;
constexpr int kExponentBias = 127;

}  // namespace

// The upper bits of a float, exponent and first bits of the mantissa, count the buckets.
std::size_t JumpHistogram::bucket_of(float size) noexcept {
  constexpr std::uint32_t kFirst = static_cast<std::uint32_t>(kExponentBias + kLowestPower)
                                   << kSubBits;
  const std::uint32_t place = std::bit_cast<std::uint32_t>(size) >> (kMantissaBits - kSubBits);
  if (place < kFirst) return 0;
  return std::min<std::size_t>(place - kFirst + 1, kBuckets - 1);
}

double JumpHistogram::upper_end(std::size_t bucket) noexcept {
  if (bucket == 0) return 0;
  constexpr double kSubs = 1U << kSubBits;
  const auto power = static_cast<int>((bucket - 1) >> kSubBits) + kLowestPower;
  const auto sub = static_cast<double>((bucket - 1) % (1U << kSubBits));
  return std::ldexp(1.0 + (sub + 1.0) / kSubs, power);
}

void JumpHistogram::add(double size) noexcept {
  // The negated comparison catches NaN too.
  const auto kept =
      !(size > 0) ? 0.0F
                  : static_cast<float>(std::min(size, double{std::numeric_limits<float>::max()}));
  std::uint16_t& bucket = buckets_[bucket_of(kept)];
  if (bucket == std::numeric_limits<std::uint16_t>::max()) halve();
  ++bucket;
  ++count_;
  max_ = std::max(max_, kept);
}

void JumpHistogram::halve() noexcept {
  for (std::uint16_t& bucket : buckets_) bucket = static_cast<std::uint16_t>(bucket / 2);
}

double JumpHistogram::percentile(double share) const noexcept {
  const auto kept = std::accumulate(buckets_.begin(), buckets_.end(), std::uint64_t{0});
  if (kept == 0) return 0;
  const double clamped = std::clamp(share, 0.0, 1.0);
  const auto rank = std::max<std::uint64_t>(
      static_cast<std::uint64_t>(std::ceil(clamped * static_cast<double>(kept))), 1);
  std::uint64_t below = 0;
  for (std::size_t bucket = 0; bucket < kBuckets; ++bucket) {
    below += buckets_[bucket];
    if (below >= rank) return std::min(upper_end(bucket), double{max_});
  }
  return max_;
}

}  // namespace reckon::tools
