// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Between std::chrono at interfaces and double seconds in formulas, for all folders.
#pragma once

#include <chrono>
#include <cmath>
#include <cstdint>

namespace reckon::pdu {

[[nodiscard]] constexpr double to_seconds(std::chrono::nanoseconds time) noexcept {
  return std::chrono::duration<double>(time).count();
}

/// `seconds` within +-9e9; rounds to the nearest nanosecond.
[[nodiscard]] inline std::chrono::nanoseconds from_seconds(double seconds) noexcept {
  return std::chrono::nanoseconds(static_cast<std::int64_t>(std::llround(seconds * 1e9)));
}

}  // namespace reckon::pdu
