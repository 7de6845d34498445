// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/velocity_trend.hpp"

#include <algorithm>
#include <cmath>

#include "reckon/pdu/seconds.hpp"

namespace reckon::peer {
namespace {

// Interval of the difference [s]: a longer one lags more, a shorter one is noisier.
constexpr double kLongest = 0.0021;
constexpr double kShortest = 0.0009;
constexpr double kMemory = 0.1;  // [s], memory of the unevenness

}  // namespace

void VelocityTrend::note(std::chrono::nanoseconds time, const Eigen::Vector3d& velocity) noexcept {
  const double dt = pdu::to_seconds(time - back(0).time);
  if (!(dt > 0)) return;
  if (dt > kMemory) {
    kept_.fill({time, velocity});
    unevenness_ = 0.0;
  }
  newest_ = (newest_ + 1) % kKept;
  kept_[newest_] = {time, velocity};

  const Span last = span_to(0);
  acceleration_.setZero();
  jerk_.setZero();
  if (last.length > 0) {
    acceleration_ = difference(last, 0);
    const Span before = span_to(last.begin);
    if (before.length > 0) {
      const double apart = 0.5 * (last.length + before.length);
      jerk_ = (acceleration_ - difference(before, last.begin)) / apart;
    }
  }

  const Eigen::Vector3d third =
      back(0).value - 3.0 * back(1).value + 3.0 * back(2).value - back(3).value;
  const double uneven = third.squaredNorm();
  unevenness_ += dt / (kMemory + dt) * (uneven - unevenness_);
  doubt_ = last.length > 0 ? std::sqrt(std::max(unevenness_, uneven)) / last.length : 0.0;
}

VelocityTrend::Span VelocityTrend::span_to(std::size_t end) const noexcept {
  Span span;
  for (std::size_t i = end + 1; i < kKept; ++i) {
    const double length = pdu::to_seconds(back(end).time - back(i).time);
    if (length < kShortest || length > kLongest || length < span.length) continue;
    span = {i, length};
  }
  return span;
}

}  // namespace reckon::peer
