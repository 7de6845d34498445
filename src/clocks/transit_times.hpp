// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Transit times of datagrams, from the send times in their trailers. The loop that reads the
// datagrams counts them, and any other thread may read the counts while it runs.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>

#include "reckon/peer/counters/log_linear.hpp"

namespace reckon::peer {

/// One-way delays in buckets of at most 1/16 relative width, 1 us to 134 s. They include the
/// difference of the two clocks. 3 KB, no allocation. add() by one thread, counts() by any,
/// possibly without the newest.
class TransitTimes {
 public:
  using Buckets = LogLinear<4>;
  static constexpr std::size_t kBuckets = Buckets::bucket_of((std::uint64_t{1} << 27) - 1) + 1;
  using Counts = std::array<std::uint64_t, kBuckets>;

  /// A negative delay, caused by a difference of the clocks, counts as zero. About 2 ns.
  void add(std::chrono::nanoseconds delay) noexcept {
    const std::int64_t us = std::max<std::int64_t>(delay.count() / 1000, 0);
    auto& bucket =
        buckets_[std::min(Buckets::bucket_of(static_cast<std::uint64_t>(us)), kBuckets - 1)];
    // With one writer a load and a store are enough and cost no locked instruction.
    bucket.store(bucket.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  }

  /// All since the construction, by bucket.
  [[nodiscard]] Counts counts() const noexcept {
    Counts counts;
    std::transform(buckets_.begin(), buckets_.end(), counts.begin(),
                   [](const auto& bucket) { return bucket.load(std::memory_order_relaxed); });
    return counts;
  }

 private:
  std::array<std::atomic<std::uint64_t>, kBuckets> buckets_{};
};

}  // namespace reckon::peer
