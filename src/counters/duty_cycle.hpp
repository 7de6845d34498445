// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Punctuality of a loop: lateness, step time and misses. The loop's thread counts them, and any
// other thread may read them while it runs.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "reckon/peer/counters/histogram.hpp"

namespace reckon::peer {

/// Durations in buckets of at most 1/32 relative width, 1 ns to 2^40 ns (18 minutes): below 32 ns a
/// bucket is one nanosecond, above that each power of two has 32 buckets. 9 KB. Negative durations
/// count as 0, longer ones as the longest.
struct DurationScale {
  using Value = std::chrono::nanoseconds;
  using Kept = std::int64_t;
  using Count = std::uint64_t;
  using Buckets = LogLinear<5>;
  static constexpr std::size_t kBuckets = Buckets::kSub * 37;
  static constexpr bool kShared = true;

  static Kept keep(Value value) noexcept { return std::max<Kept>(value.count(), 0); }
  static Value value_of(Kept kept) noexcept { return Value(kept); }
  static std::size_t bucket_of(Kept kept) noexcept {
    return std::min(Buckets::bucket_of(static_cast<std::uint64_t>(kept)), kBuckets - 1);
  }
  static Kept last_of(std::size_t bucket) noexcept {
    return bucket + 1 < kBuckets ? static_cast<Kept>(Buckets::end_of(bucket) - 1)
                                 : std::numeric_limits<Kept>::max();
  }
};
using DurationHistogram = Histogram<DurationScale>;

/// p50, p99, p99.9 and maximum of a histogram.
struct Percentiles {
  std::chrono::nanoseconds p50{0}, p99{0}, p999{0}, max{0};
};
[[nodiscard]] Percentiles percentiles(const DurationHistogram& histogram) noexcept;

/// The statistics of one periodic loop.
class DutyCycle {
 public:
  /// `period` > 0 (assert).
  explicit DutyCycle(std::chrono::nanoseconds period) noexcept;

  /// Records one step that was due at `scheduled`, began at `started` and ended at `finished`. Its
  /// lateness is started - scheduled. A step that ends after the next was due is an overrun. Each
  /// step that was due before it ended is missed, because the loop omits it. Only by the loop's
  /// thread.
  void record(std::chrono::nanoseconds scheduled, std::chrono::nanoseconds started,
              std::chrono::nanoseconds finished) noexcept;

  [[nodiscard]] std::chrono::nanoseconds period() const noexcept { return period_; }
  [[nodiscard]] std::uint64_t steps() const noexcept { return step_time_.count(); }
  /// Periods without a step of their own.
  [[nodiscard]] std::uint64_t missed() const noexcept;
  /// Steps that ended later than a period after they were due.
  [[nodiscard]] std::uint64_t overruns() const noexcept;
  [[nodiscard]] const DurationHistogram& lateness() const noexcept { return lateness_; }
  [[nodiscard]] const DurationHistogram& step_time() const noexcept { return step_time_; }

 private:
  std::chrono::nanoseconds period_;
  DurationHistogram lateness_;
  DurationHistogram step_time_;
  std::atomic<std::uint64_t> missed_{0};
  std::atomic<std::uint64_t> overruns_{0};
};

/// The passes of a loop that runs when there is work. Threads as for DutyCycle.
class PassTimes {
 public:
  /// @param limit a longer pass is an overrun
  explicit PassTimes(std::chrono::nanoseconds limit) noexcept : limit_(limit) {}

  /// Records a pass. Only by the loop's thread; some 5 ns.
  void record(std::chrono::nanoseconds started, std::chrono::nanoseconds finished) noexcept;

  [[nodiscard]] std::chrono::nanoseconds limit() const noexcept { return limit_; }
  [[nodiscard]] std::uint64_t overruns() const noexcept {
    return overruns_.load(std::memory_order_relaxed);
  }
  [[nodiscard]] const DurationHistogram& times() const noexcept { return times_; }

 private:
  std::chrono::nanoseconds limit_;
  DurationHistogram times_;
  std::atomic<std::uint64_t> overruns_{0};
};

}  // namespace reckon::peer
