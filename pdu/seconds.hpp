// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Conversion between std::chrono in interfaces and double seconds in formulas, for all folders.
#pragma once

#include <chrono>
#include <cstdint>
#include <limits>

namespace reckon::pdu {

[[nodiscard]] constexpr double to_seconds(std::chrono::nanoseconds time) noexcept {
  return std::chrono::duration<double>(time).count();
}

/// The nearest integer, halves away from zero, as std::llround. Beyond +-9e18 the largest or least
/// integer, for NaN the least. Inline, because each update needs it several times.
[[nodiscard]] constexpr std::int64_t rounded(double value) noexcept {
  if (!(value > -9e18)) return std::numeric_limits<std::int64_t>::min();
  if (value > 9e18) return std::numeric_limits<std::int64_t>::max();
  const auto whole = static_cast<std::int64_t>(value);
  const double rest = value - static_cast<double>(whole);
  return whole + (rest >= 0.5 ? 1 : 0) - (rest <= -0.5 ? 1 : 0);
}

/// `seconds` within +-9e9; rounds to the nearest nanosecond.
[[nodiscard]] constexpr std::chrono::nanoseconds from_seconds(double seconds) noexcept {
  return std::chrono::nanoseconds(rounded(seconds * 1e9));
}

}  // namespace reckon::pdu
