// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/counters/duty_cycle.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace reckon::peer {
namespace {

constexpr std::uint64_t kSub = DurationHistogram::kSubBuckets;
constexpr unsigned kSubBits = 5;
static_assert(kSub == std::uint64_t{1} << kSubBits);

// Below 32 ns a bucket is one nanosecond; above, each power of two has 32 buckets.
std::size_t bucket_of(std::uint64_t ns) noexcept {
  if (ns < kSub) return static_cast<std::size_t>(ns);
  const unsigned shift = static_cast<unsigned>(std::bit_width(ns)) - 1 - kSubBits;
  const std::size_t bucket = static_cast<std::size_t>(shift * kSub + (ns >> shift));
  return std::min(bucket, DurationHistogram::kBuckets - 1);
}

// The longest duration of a bucket [ns].
std::uint64_t upper_end(std::size_t bucket) noexcept {
  if (bucket < kSub) return bucket;
  const std::uint64_t shift = bucket / kSub - 1;
  return ((bucket - shift * kSub + 1) << shift) - 1;
}

}  // namespace

void DurationHistogram::add(std::chrono::nanoseconds duration) noexcept {
  const std::int64_t ns = std::max<std::int64_t>(duration.count(), 0);
  auto& bucket = buckets_[bucket_of(static_cast<std::uint64_t>(ns))];
  // One writer: a load and a store are enough and cost no locked instruction.
  bucket.store(bucket.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  if (ns > max_.load(std::memory_order_relaxed)) max_.store(ns, std::memory_order_relaxed);
  count_.store(count_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
}

std::uint64_t DurationHistogram::count() const noexcept {
  return count_.load(std::memory_order_acquire);
}

std::chrono::nanoseconds DurationHistogram::max() const noexcept {
  return std::chrono::nanoseconds{max_.load(std::memory_order_relaxed)};
}

std::chrono::nanoseconds DurationHistogram::percentile(double share) const noexcept {
  const std::uint64_t all = count();
  if (all == 0) return std::chrono::nanoseconds{0};
  const double clamped = std::clamp(share, 0.0, 1.0);
  const auto rank = std::max<std::uint64_t>(
      static_cast<std::uint64_t>(std::ceil(clamped * static_cast<double>(all))), 1);
  std::uint64_t below = 0;
  for (std::size_t bucket = 0; bucket < kBuckets; ++bucket) {
    below += buckets_[bucket].load(std::memory_order_relaxed);
    if (below < rank) continue;
    const auto end = std::chrono::nanoseconds{static_cast<std::int64_t>(upper_end(bucket))};
    return bucket + 1 == kBuckets ? max() : std::min(end, max());
  }
  return max();
}

Percentiles percentiles(const DurationHistogram& histogram) noexcept {
  return {histogram.percentile(0.5), histogram.percentile(0.99), histogram.percentile(0.999),
          histogram.max()};
}

DutyCycle::DutyCycle(std::chrono::nanoseconds period) noexcept : period_(period) {
  assert(period.count() > 0);
}

void DutyCycle::record(std::chrono::nanoseconds scheduled, std::chrono::nanoseconds started,
                       std::chrono::nanoseconds finished) noexcept {
  const std::chrono::nanoseconds late = std::max(started - scheduled, std::chrono::nanoseconds{0});
  lateness_.add(late);
  step_time_.add(finished - started);
  if (late >= period_) {
    missed_.fetch_add(static_cast<std::uint64_t>(late / period_), std::memory_order_relaxed);
  }
  if (finished - scheduled > period_) overruns_.fetch_add(1, std::memory_order_relaxed);
}

std::uint64_t DutyCycle::missed() const noexcept { return missed_.load(std::memory_order_relaxed); }

std::uint64_t DutyCycle::overruns() const noexcept {
  return overruns_.load(std::memory_order_relaxed);
}

}  // namespace reckon::peer
