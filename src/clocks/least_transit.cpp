// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/clocks/least_transit.hpp"

#include <algorithm>
#include <cmath>

#include "reckon/pdu/seconds.hpp"

namespace reckon::peer {

using std::chrono::nanoseconds;

void LeastTransit::note(nanoseconds difference, nanoseconds now) noexcept {
  if (!started_ || now - window_start_ > kWindow) {
    if (started_) close(now);
    started_ = true;
    window_start_ = now;
    current_ = {now, difference};
  } else if (difference <= carried(current_, now)) {
    current_ = {now, difference};
  }
}

void LeastTransit::close(nanoseconds now) noexcept {
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

// Least-squares slope through the windows' points, less twice its standard error.
double LeastTransit::fitted_drift() const noexcept {
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

}  // namespace reckon::peer
