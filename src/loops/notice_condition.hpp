// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A condition that is reported once when it begins and once when it ends.
#pragma once

#include <chrono>
#include <cstdint>

namespace reckon::peer {

/// Begins at once, and ends after three seconds of absence.
class NoticeCondition {
 public:
  enum class Turn : std::uint8_t { none, begins, ends };

  [[nodiscard]] Turn turn(bool present, std::chrono::nanoseconds now) noexcept {
    constexpr std::chrono::nanoseconds kCalm = std::chrono::seconds(3);
    if (present) seen_ = now;
    if (present == lasts_ || (lasts_ && now - seen_ < kCalm)) return Turn::none;
    lasts_ = present;
    return present ? Turn::begins : Turn::ends;
  }

 private:
  bool lasts_ = false;
  std::chrono::nanoseconds seen_{0};
};

}  // namespace reckon::peer
