// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/velocity_trend.hpp"

#include <algorithm>
#include <cmath>

#include "reckon/pdu/seconds.hpp"

namespace reckon::peer {
namespace {

// Over so much [s] the difference is taken: more lags, less is noise.
constexpr double kLongest = 0.0021;
constexpr double kShortest = 0.0009;
constexpr double kMemory = 0.1;  // [s], of how uneven velocities are

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

  double span = 0.0;
  acceleration_.setZero();
  for (std::size_t i = 1; i < kKept; ++i) {
    const double age = pdu::to_seconds(time - back(i).time);
    if (age < kShortest || age > kLongest || age < span) continue;
    span = age;
    acceleration_ = (velocity - back(i).value) / age;
  }

  const Eigen::Vector3d third =
      back(0).value - 3.0 * back(1).value + 3.0 * back(2).value - back(3).value;
  const double uneven = third.squaredNorm();
  unevenness_ += dt / (kMemory + dt) * (uneven - unevenness_);
  doubt_ = span > 0 ? std::sqrt(std::max(unevenness_, uneven)) / span : 0.0;
}

}  // namespace reckon::peer
