// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/contact/surface_tracker.hpp"

#include <algorithm>
#include <cmath>

namespace reckon::haptics {
namespace {

constexpr double kDelaysPerTau = 2.0;
constexpr double kShortest = 0.002;        // [s]
constexpr double kLongest = 0.1;           // [s]
constexpr double kRow = 11000.0;           // [N/m/s], stiffness over the least tau in a row
constexpr double kVelocityRatio = 2.0;     // time constant of u over tau
constexpr double kPlayed = 0.005;          // [s], for a playback
constexpr double kSmoothing = 0.2;         // weight of a new update
constexpr double kLongestInterval = 0.02;  // [s]
// Close following, for one hand alone that is near.
constexpr double kStiff = 1400.0;         // [N/m]
constexpr double kShortestClose = 0.003;  // [s]
constexpr double kPace = 0.02;            // [m/s]
constexpr double kNearAge = 0.0025;       // [s]
constexpr double kOften = 0.01;           // [s]
constexpr double kSeldom = 0.0195;        // [s]
constexpr double kCloseCoupling = 4.5;    // [N s/m]

}  // namespace

void SurfaceTracker::learn(double age, double interval, double miss) noexcept {
  if (!std::isfinite(age) || !std::isfinite(interval)) return;
  const double line = std::clamp(age, 0.0, 1.0);
  const double waited = std::clamp(interval, 0.0, kLongestInterval);
  const double take = learnt_ ? kSmoothing : 1.0;
  age_ += take * (line - age_);
  delay_ += take * (line + waited - delay_);
  miss_ += take * (miss - miss_);
  learnt_ = true;
}

double SurfaceTracker::time_constant(const Following& how) const noexcept {
  if (how.played) return kPlayed;
  const double least = how.in_row ? how.stiffness / kRow : 0.0;
  const double calm = std::clamp(std::max(kDelaysPerTau * delay_, least), kShortest, kLongest);
  const double interval = delay_ - age_;
  const bool known = interval < (age_ < kNearAge ? kSeldom : kOften);
  if (!how.alone || !known || !(how.stiffness * age_ < kCloseCoupling)) return calm;
  const double coupling = how.stiffness / kStiff * (delay_ + age_);
  const double close = std::max({coupling, kShortestClose, miss_ / kPace});
  return std::min(close, calm);
}

Eigen::Vector3d SurfaceTracker::follow(const Eigen::Vector3d& predicted_before,
                                       const Eigen::Vector3d& predicted,
                                       const Eigen::Vector3d& shown, double dt,
                                       const Following& how) noexcept {
  const double tau = time_constant(how);
  const Eigen::Vector3d wanted = (predicted - predicted_before) / dt;
  velocity_ += std::min(1.0, dt / (kVelocityRatio * tau)) * (wanted - velocity_);
  const Eigen::Vector3d moved = shown + velocity_ * dt;
  const double share = std::min(1.0, how.weight * std::min(how.share, dt / tau));
  return moved + share * (predicted - moved);
}

}  // namespace reckon::haptics
