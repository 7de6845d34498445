// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/contact/surface_tracker.hpp"

#include <algorithm>
#include <cmath>

namespace reckon::haptics {
namespace {

constexpr double kDelaysPerTau = 5.0;
constexpr double kShortest = 0.002;         // [s]
constexpr double kLongest = 0.1;            // [s]
constexpr double kVelocityRatio = 2.0;      // time constant of u over tau
constexpr double kSmoothing = 0.2;          // weight of a new update in D
constexpr double kFreeInterval = 0.005;     // [s], closer updates do not count as delay
constexpr double kLongestInterval = 0.025;  // [s]
constexpr double kNotableMiss = 0.0005;     // [m]

}  // namespace

void SurfaceTracker::learn(double age, double interval, double miss) noexcept {
  if (!std::isfinite(age) || !std::isfinite(interval) || !std::isfinite(miss)) return;
  const double line = std::clamp(age, 0.0, 1.0);
  const double waited = std::clamp(interval, kFreeInterval, kLongestInterval) - kFreeInterval;
  const double weight = std::clamp(miss / kNotableMiss - 0.5, 0.0, 1.0);
  const double take = learnt_ ? kSmoothing : 1.0;
  age_ += take * (line - age_);
  delay_ += take * (line + weight * waited - delay_);
  learnt_ = true;
}

double SurfaceTracker::time_constant() const noexcept {
  return std::clamp(kDelaysPerTau * delay_, kShortest, kLongest);
}

Eigen::Vector3d SurfaceTracker::follow(const Eigen::Vector3d& predicted_before,
                                       const Eigen::Vector3d& predicted,
                                       const Eigen::Vector3d& shown, double dt) noexcept {
  const double tau = time_constant();
  const Eigen::Vector3d wanted = (predicted - predicted_before) / dt;
  velocity_ += std::min(1.0, dt / (kVelocityRatio * tau)) * (wanted - velocity_);
  const Eigen::Vector3d moved = shown + velocity_ * dt;
  return moved + std::min(1.0, dt / tau) * (predicted - moved);
}

}  // namespace reckon::haptics
