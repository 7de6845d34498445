// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The common histogram: percentiles of durations, errors and jumps without storing each value.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>

#include "reckon/peer/counters/log_linear.hpp"

namespace reckon::peer {

/// p50, p99, p99.9 and maximum of a distribution, in its own unit.
struct Spread {
  double p50 = 0, p99 = 0, p999 = 0, max = 0;
  std::uint64_t count = 0;
};

/// Distribution of values in the buckets of a scale. No allocation. One thread adds. On a shared
/// scale any thread reads meanwhile, and may miss the newest.
///
/// A scale has Value, of add() and the answers; Kept, a Value as it is stored; Count, of a bucket;
/// kBuckets; kShared; keep(Value), which takes any Value into the range; value_of(Kept);
/// bucket_of(Kept); and last_of(bucket), its largest Kept. Where a Count is smaller than 64 bits, a
/// full bucket halves all of them: old values fade, the shape stays.
template <typename Scale>
class Histogram {
 public:
  using Value = typename Scale::Value;

  /// About 3 ns.
  void add(Value value) noexcept {
    const Kept kept = Scale::keep(value);
    Count& bucket = buckets_[Scale::bucket_of(kept)];
    if constexpr (kFades) {
      if (bucket == std::numeric_limits<Count>::max())
        for (Count& each : buckets_) each = static_cast<Count>(each / 2);
    }
    // With one writer a load and a store are enough and cost no locked instruction.
    store(bucket, static_cast<Count>(bucket + 1));
    if (kept > max_) store(max_, kept);
    store(count_, count_ + 1, std::memory_order_release);
  }

  /// Values added.
  [[nodiscard]] std::uint64_t count() const noexcept {
    return load(count_, std::memory_order_acquire);
  }
  /// The largest one added; 0 if none.
  [[nodiscard]] Value max() const noexcept { return Scale::value_of(load(max_)); }
  /// The smallest value with at least `share` (0 to 1) of all at or below it, as in a sorted list
  /// at index ceil(share n) - 1, rounded up within its bucket and never above max(). 0 if none were
  /// added.
  [[nodiscard]] Value percentile(double share) const noexcept {
    const std::uint64_t all =
        kFades ? std::accumulate(buckets_.begin(), buckets_.end(), std::uint64_t{0}) : count();
    if (all == 0) return Scale::value_of(Kept{});
    const std::size_t bucket = bucket_of_share(Scale::kBuckets, all, share,
                                               [&](std::size_t i) { return load(buckets_[i]); });
    return Scale::value_of(std::min(Scale::last_of(bucket), load(max_)));
  }
  [[nodiscard]] Spread spread() const noexcept requires std::same_as<Value, double> {
    return {percentile(0.5), percentile(0.99), percentile(0.999), max(), count()};
  }

 private:
  using Kept = typename Scale::Kept;
  using Count = typename Scale::Count;
  static constexpr bool kFades = sizeof(Count) < sizeof(std::uint64_t);
  static_assert(!(kFades && Scale::kShared), "halving is not atomic");

  template <typename T>
  static T load(const T& cell, std::memory_order order = std::memory_order_relaxed) noexcept {
    if constexpr (!Scale::kShared) return cell;
    return std::atomic_ref(const_cast<T&>(cell)).load(order);
  }
  template <typename T>
  static void store(T& cell, T value,
                    std::memory_order order = std::memory_order_relaxed) noexcept {
    if constexpr (Scale::kShared) {
      std::atomic_ref(cell).store(value, order);
    } else {
      cell = value;
    }
  }

  std::array<Count, Scale::kBuckets> buckets_{};
  std::uint64_t count_ = 0;
  Kept max_{};
};

}  // namespace reckon::peer
