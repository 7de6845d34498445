// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The offset between two clocks for the fastest packets: arrivals minus send times without queueing
// delays.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>

#include "reckon/pdu/seconds.hpp"

namespace reckon::peer {

/// Smallest difference "arrival on our clock - sending on theirs" of the last 10 to 20 s, and its
/// growth, from the smallest ones of up to five such windows. That is the least transit minus the
/// lead of their clock.
///
/// The drift is used only as far as the windows show it beyond doubt (twice its standard error).
/// One thread, no allocation; a few ns a call, some 50 ns once in 10 s.
class LeastTransit {
 public:
  static constexpr std::chrono::nanoseconds kWindow = std::chrono::seconds(10);
  /// Silence after which the measurements are discarded.
  static constexpr std::chrono::nanoseconds kForgotten = std::chrono::seconds(60);
  /// Largest drift of a usable clock [s/s].
  static constexpr double kMostDrift = 1e-3;

  /// Records one packet. `now` must not fall.
  void note(std::chrono::nanoseconds difference, std::chrono::nanoseconds now) noexcept;
  /// The smallest difference, extrapolated to `now`; 0 before the first packet.
  [[nodiscard]] std::chrono::nanoseconds at(std::chrono::nanoseconds now) const noexcept {
    const std::chrono::nanoseconds current = carried(current_, now);
    if (closed_count_ == 0) return current;
    return std::min(current, carried(closed_[closed_count_ - 1], now));
  }
  /// Growth of the difference [s/s], within kMostDrift: positive when their clock is slow.
  [[nodiscard]] double drift() const noexcept { return drift_; }
  [[nodiscard]] bool is_empty() const noexcept { return !started_; }

 private:
  struct Least {
    std::chrono::nanoseconds at{0};
    std::chrono::nanoseconds difference{0};
  };
  static constexpr std::size_t kClosed = 5;

  [[nodiscard]] std::chrono::nanoseconds carried(const Least& least,
                                                 std::chrono::nanoseconds now) const noexcept {
    if (drift_ == 0.0) return least.difference;
    return least.difference + pdu::from_seconds(drift_ * pdu::to_seconds(now - least.at));
  }
  void close(std::chrono::nanoseconds now) noexcept;
  [[nodiscard]] double fitted_drift() const noexcept;

  bool started_ = false;
  std::chrono::nanoseconds window_start_{0};
  Least current_;
  std::array<Least, kClosed> closed_{};  // oldest first
  std::size_t closed_count_ = 0;
  double drift_ = 0.0;
};

}  // namespace reckon::peer
