// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Times of captures, limited so that their differences do not overflow.
#pragma once

#include <algorithm>
#include <chrono>

namespace reckon::tools {

/// `time` limited to the range from 1970 to 126 years later.
[[nodiscard]] constexpr std::chrono::nanoseconds bounded_time(std::chrono::nanoseconds time) {
  constexpr std::chrono::nanoseconds kLatest{4'000'000'000'000'000'000};
  return std::clamp(time, std::chrono::nanoseconds::zero(), kLatest);
}

}  // namespace reckon::tools
