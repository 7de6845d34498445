// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/listener/jump_histogram.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "reckon/peer/counters/log_linear.hpp"

namespace reckon::tools {
namespace {

using Buckets = peer::LogLinear<3>;

}  // namespace

std::size_t JumpHistogram::bucket_of(double size) noexcept {
  const auto units = static_cast<std::uint64_t>(std::min(size, kLargest) * kUnitsPerOne);
  // What is below the least power shares the first bucket.
  return std::max<std::size_t>(Buckets::bucket_of(units), kMerged) - kMerged;
}

double JumpHistogram::upper_end(std::size_t bucket) noexcept {
  if (bucket == 0) return 0;
  return static_cast<double>(Buckets::end_of(bucket + kMerged)) / kUnitsPerOne;
}

void JumpHistogram::add(double size) noexcept {
  // The negated comparison catches NaN too.
  const auto kept =
      !(size > 0) ? 0.0F
                  : static_cast<float>(std::min(size, double{std::numeric_limits<float>::max()}));
  std::uint16_t& bucket = buckets_[bucket_of(double{kept})];
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
  const std::size_t bucket = peer::bucket_of_share(
      kBuckets, kept, share, [&](std::size_t place) { return buckets_[place]; });
  return std::min(upper_end(bucket), double{max_});
}

}  // namespace reckon::tools
