// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/clocks/clock.hpp"

#include <cassert>

namespace reckon::peer {

std::chrono::nanoseconds SteadyClock::now() const noexcept {
  return std::chrono::steady_clock::now().time_since_epoch();
}

std::chrono::nanoseconds SteadyClock::utc_now() const noexcept {
  return std::chrono::system_clock::now().time_since_epoch();
}

ManualClock::ManualClock(std::chrono::nanoseconds start,
                         std::chrono::nanoseconds utc_offset) noexcept
    : now_(start.count()), utc_offset_(utc_offset) {}

std::chrono::nanoseconds ManualClock::now() const noexcept {
  return std::chrono::nanoseconds{now_.load(std::memory_order_acquire)};
}

std::chrono::nanoseconds ManualClock::utc_now() const noexcept { return now() + utc_offset_; }

void ManualClock::advance(std::chrono::nanoseconds step) noexcept {
  assert(step.count() >= 0);
  now_.fetch_add(step.count(), std::memory_order_acq_rel);
}

void ManualClock::set(std::chrono::nanoseconds time) noexcept {
  assert(time >= now());
  now_.store(time.count(), std::memory_order_release);
}

}  // namespace reckon::peer
