// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/counters/duty_cycle.hpp"

#include <algorithm>
#include <cassert>

namespace reckon::peer {
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
  // a step that is due at this moment is still made
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
