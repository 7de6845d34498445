// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/counters/duty_cycle.hpp"

#include <algorithm>
#include <cassert>

#include "reckon/peer/counters/log_linear.hpp"

namespace reckon::peer {
namespace {

// Below 32 ns a bucket is one nanosecond; above, each power of two has 32 buckets.
using Buckets = LogLinear<5>;
static_assert(Buckets::kSub == DurationHistogram::kSubBuckets);

std::size_t bucket_of(std::uint64_t ns) noexcept {
  return std::min(Buckets::bucket_of(ns), DurationHistogram::kBuckets - 1);
}

}  // namespace

void DurationHistogram::add(std::chrono::nanoseconds duration) noexcept {
  const std::int64_t ns = std::max<std::int64_t>(duration.count(), 0);
  auto& bucket = buckets_[bucket_of(static_cast<std::uint64_t>(ns))];
  // With one writer a load and a store are enough and cost no locked instruction.
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
  const std::size_t bucket = bucket_of_share(kBuckets, all, share, [&](std::size_t place) {
    return buckets_[place].load(std::memory_order_relaxed);
  });
  if (bucket + 1 >= kBuckets) return max();
  const auto longest = static_cast<std::int64_t>(Buckets::end_of(bucket) - 1);
  return std::min(std::chrono::nanoseconds{longest}, max());
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
  const std::chrono::nanoseconds taken = finished - scheduled;
  if (taken <= period_) return;
  overruns_.fetch_add(1, std::memory_order_relaxed);
  // One that is due just now has a step of its own.
  const auto left_out = (taken - std::chrono::nanoseconds{1}) / period_;
  missed_.fetch_add(static_cast<std::uint64_t>(left_out), std::memory_order_relaxed);
}

std::uint64_t DutyCycle::missed() const noexcept { return missed_.load(std::memory_order_relaxed); }

std::uint64_t DutyCycle::overruns() const noexcept {
  return overruns_.load(std::memory_order_relaxed);
}

void PassTimes::record(std::chrono::nanoseconds started,
                       std::chrono::nanoseconds finished) noexcept {
  times_.add(finished - started);
  if (finished - started > limit_) overruns_.fetch_add(1, std::memory_order_relaxed);
}

}  // namespace reckon::peer
