// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Which bodies a local hand has touched lately.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace reckon::haptics {

/// Servo thread; allocates at construction only.
class TouchedBodies {
 public:
  static constexpr std::chrono::milliseconds kLately{50};

  explicit TouchedBodies(std::size_t bodies) : until_(bodies) { touched_.reserve(bodies); }

  /// @return whether it was not touched lately
  bool touch(std::uint32_t body, std::chrono::nanoseconds now) noexcept {
    const bool is_new = until_[body] == std::chrono::nanoseconds(0);
    until_[body] = now + kLately;
    if (is_new) touched_.push_back(body);
    return is_new;
  }
  /// Calls forget(body) for each body that was last touched before kLately.
  void expire(std::chrono::nanoseconds now, auto&& forget) noexcept {
    std::erase_if(touched_, [&](std::uint32_t body) {
      if (until_[body] >= now) return false;
      until_[body] = std::chrono::nanoseconds(0);
      forget(body);
      return true;
    });
  }

 private:
  std::vector<std::chrono::nanoseconds> until_;  // by body; 0: not touched
  std::vector<std::uint32_t> touched_;
};

}  // namespace reckon::haptics
