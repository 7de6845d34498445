// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Punctuality of a loop: lateness, step time and misses, counted by the loop's thread and readable
// by any other while it runs.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace reckon::peer {

/// Durations in buckets of at most 1/32 relative width, 1 ns to 2^40 ns (18 minutes); no
/// allocation, 9 KB. add() by one thread, the rest by any; reading while adding may miss the
/// newest.
class DurationHistogram {
 public:
  static constexpr std::size_t kSubBuckets = 32;
  static constexpr std::size_t kBuckets = kSubBuckets * 37;

  /// Negative durations count as 0, longer ones as the longest. About 3 ns.
  void add(std::chrono::nanoseconds duration) noexcept;

  [[nodiscard]] std::uint64_t count() const noexcept;
  /// The largest one added, exact; 0 if none.
  [[nodiscard]] std::chrono::nanoseconds max() const noexcept;
  /// The smallest duration with at least `share` (0 to 1) of all at or below it, as in a sorted
  /// list at index ceil(share n) - 1, rounded up by at most 1/32. 0 if none were added.
  [[nodiscard]] std::chrono::nanoseconds percentile(double share) const noexcept;

 private:
  std::array<std::atomic<std::uint64_t>, kBuckets> buckets_{};
  std::atomic<std::uint64_t> count_{0};
  std::atomic<std::int64_t> max_{0};
};

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
  /// lateness is started - scheduled. One that ends after the next was due is an overrun, and each
  /// that was due before it ended is missed: the loop leaves it out. Only by the loop's thread.
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

/// The passes of a loop that runs when there is work. As DutyCycle, by one thread and any.
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
