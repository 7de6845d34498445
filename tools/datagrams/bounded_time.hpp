// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Times of captures, which may say anything, so that differences of them do not overflow.
#pragma once

#include <algorithm>
#include <chrono>

namespace reckon::tools {

/// `time` since 1970, not before and at most 126 years behind it.
[[nodiscard]] constexpr std::chrono::nanoseconds bounded_time(std::chrono::nanoseconds time) {
  constexpr std::chrono::nanoseconds kLatest{4'000'000'000'000'000'000};
  return std::clamp(time, std::chrono::nanoseconds::zero(), kLatest);
}

}  // namespace reckon::tools
