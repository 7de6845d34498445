// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The offset between two clocks for the fastest packets: arrivals minus send times without queueing
// delays.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
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
  void note(std::chrono::nanoseconds difference, std::chrono::nanoseconds now) noexcept {
    if (!started_ || now - window_start_ > kWindow) {
      if (started_) close(now);
      started_ = true;
      window_start_ = now;
      current_ = {now, difference};
    } else if (difference <= carried(current_, now)) {
      current_ = {now, difference};
    }
  }
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
  void close(std::chrono::nanoseconds now) noexcept {
    if (now - current_.at > kForgotten) {
      closed_count_ = 0;
      drift_ = 0.0;
      return;
    }
    if (closed_count_ == kClosed) {
      std::move(closed_.begin() + 1, closed_.end(), closed_.begin());
      --closed_count_;
    }
    closed_[closed_count_++] = current_;
    drift_ = fitted_drift();
  }
  [[nodiscard]] double fitted_drift() const noexcept {
    // Least-squares slope through the windows' points, less twice its standard error.
    if (closed_count_ < 4) return 0.0;
    const auto n = static_cast<double>(closed_count_);
    std::array<double, kClosed> x{}, y{};
    double mean_x = 0.0, mean_y = 0.0;
    for (std::size_t i = 0; i < closed_count_; ++i) {
      x[i] = pdu::to_seconds(closed_[i].at - closed_[0].at);
      y[i] = pdu::to_seconds(closed_[i].difference - closed_[0].difference);
      mean_x += x[i] / n;
      mean_y += y[i] / n;
    }
    double xx = 0.0, xy = 0.0, yy = 0.0;
    for (std::size_t i = 0; i < closed_count_; ++i) {
      xx += (x[i] - mean_x) * (x[i] - mean_x);
      xy += (x[i] - mean_x) * (y[i] - mean_y);
      yy += (y[i] - mean_y) * (y[i] - mean_y);
    }
    if (!(xx > 0.0)) return 0.0;
    const double slope = xy / xx;
    const double doubt = 2.0 * std::sqrt(std::max(yy - slope * xy, 0.0) / (n - 2.0) / xx);
    const double sure = std::copysign(std::max(std::abs(slope) - doubt, 0.0), slope);
    return std::clamp(sure, -kMostDrift, kMostDrift);
  }

  bool started_ = false;
  std::chrono::nanoseconds window_start_{0};
  Least current_;
  std::array<Least, kClosed> closed_{};  // oldest first
  std::size_t closed_count_ = 0;
  double drift_ = 0.0;
};

}  // namespace reckon::peer
