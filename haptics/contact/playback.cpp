// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/contact/playback.hpp"

#include <algorithm>

namespace reckon::haptics {
namespace {

constexpr double kBlowSpeed = 0.15;      // [m/s]; a slower approach is a press
constexpr double kBlowDepth = 0.008;     // [m], within the age; a slow approach strikes too
constexpr double kTrusted = 0.07;        // [s], validity of an acceleration
constexpr double kTrustedFaster = 0.03;  // [s], validity of one that raises the speed
constexpr double kSlowest = 0.05;        // [m/s]
constexpr double kLate = 0.012;          // [s]
constexpr double kFarthestBehind = 0.3;  // [s]
constexpr double kForJitter = 1.3;       // of the age
constexpr double kCycle = 0.002;         // [s], cycle of a peer

double seconds(std::chrono::nanoseconds time) noexcept {
  return 1e-9 * static_cast<double>(time.count());
}

// Moves a pose on for `longer` [s], no faster than `stated` [m/s] and not backwards.
deadreckon::Pose carry_on(deadreckon::Pose pose, const Eigen::Vector3d& stated,
                          double longer) noexcept {
  if (pose.velocity.squaredNorm() > stated.squaredNorm()) pose.velocity = stated;
  if (!(pose.velocity.dot(stated) > 0)) pose.velocity.setZero();
  pose.position += longer * pose.velocity;
  return pose;
}

}  // namespace

deadreckon::Pose hand_pose(const deadreckon::KinematicState& state, double age) noexcept {
  if (!(age > kTrustedFaster)) return deadreckon::extrapolate(state, age);
  const deadreckon::DrmTerms terms = deadreckon::drm_terms(state.algorithm);
  // Steady motion: its extrapolated direction has no further information.
  if (!terms.acceleration && !terms.body_axes) {
    if (!(age > kTrusted)) return deadreckon::extrapolate(state, age);
    const deadreckon::Pose steady = deadreckon::extrapolate(state, kTrusted);
    return carry_on(steady, steady.velocity, age - kTrusted);
  }
  const Eigen::Vector3d stated =
      terms.body_axes ? deadreckon::extrapolate(state, 0.0).velocity : state.velocity;
  deadreckon::Pose pose = deadreckon::extrapolate(state, kTrustedFaster);
  const bool faster = pose.velocity.squaredNorm() > stated.squaredNorm();
  const double trusted = faster ? kTrustedFaster : kTrusted;
  if (!(age > trusted)) return deadreckon::extrapolate(state, age);
  if (!faster) pose = deadreckon::extrapolate(state, trusted);
  return carry_on(pose, stated, age - trusted);
}

void Playback::receive(const deadreckon::KinematicState& state,
                       std::chrono::nanoseconds time) noexcept {
  if (time < heard_[newest_].time) count_ = 0;
  newest_ = (newest_ + 1) % kKept;
  count_ = std::min(count_ + 1, kKept);
  heard_[newest_] = {state, time};
}

bool Playback::is_blow(double closing, double age) noexcept {
  return closing > kBlowSpeed || (closing > kSlowest && closing * age > kBlowDepth);
}

void Playback::begin(double age) noexcept {
  if (age > kLate)
    behind_ = std::max(behind_, std::min(kFarthestBehind, kForJitter * age + kCycle));
}

void Playback::catch_up(double by) noexcept { behind_ = std::max(0.0, behind_ - by); }

deadreckon::Pose Playback::pose(std::chrono::nanoseconds now, double behind,
                                double before) const noexcept {
  const double at = seconds(now) - behind;
  std::size_t i = newest_;
  double age = at - seconds(heard_[i].time);
  for (std::size_t k = 1; age < 0 && k < count_; ++k) {
    i = (i + kKept - 1) % kKept;
    age = at - seconds(heard_[i].time);
  }
  const deadreckon::Pose pose = hand_pose(heard_[i].state, age - before);
  if (i == newest_) return pose;
  return towards(heard_[(i + 1) % kKept], pose, heard_[i], age - before);
}

// Between two received states the motion is interpolated. So a hand that was stopped after the
// first state is not extrapolated from it until the second.
deadreckon::Pose Playback::towards(const Heard& next, deadreckon::Pose pose, const Heard& last,
                                   double age) noexcept {
  const double gap = seconds(next.time) - seconds(last.time);
  if (!(gap > 0)) return pose;
  const Eigen::Vector3d missed = next.state.position - hand_pose(last.state, gap).position;
  pose.position += std::clamp(age / gap, 0.0, 1.0) * missed;
  pose.velocity += missed / gap;
  return pose;
}

}  // namespace reckon::haptics
