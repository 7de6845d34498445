// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A sender's clock as a receiver estimates it, at times that a test sets.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <optional>

#include "reckon/peer/clocks/sender_clock.hpp"

namespace reckon::peer::heard {

using std::chrono::hours;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::minutes;
using std::chrono::nanoseconds;
using std::chrono::seconds;

inline constexpr nanoseconds kUtc =
    hours(500'000) + minutes(12);          ///< some 57 years, 12 min past the hour
inline constexpr nanoseconds kUnit{1680};  ///< one unit of a DIS timestamp

/// Local steady time runs from 100 s while UTC runs from kUtc.
struct Local {
  SenderClock clock;
  nanoseconds elapsed{0};

  [[nodiscard]] nanoseconds now() const { return seconds(100) + elapsed; }
  [[nodiscard]] nanoseconds utc() const { return kUtc + elapsed; }
  std::optional<nanoseconds> hear(std::uint32_t timestamp) {
    return clock.local_time(timestamp, now(), utc());
  }
};

/// Expects that `actual` has a value, within `tolerance` of `expected`.
inline void expect_close(std::optional<nanoseconds> actual, nanoseconds expected,
                         nanoseconds tolerance) {
  ASSERT_TRUE(actual.has_value());
  EXPECT_LE(std::abs((*actual - expected).count()), tolerance.count())
      << actual->count() << " against " << expected.count();
}

}  // namespace reckon::peer::heard
