// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/servo/ungated_twin.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "reckon/deadreckon/force/force_model.hpp"
#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/pdu/seconds.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;
using std::chrono::nanoseconds;

// Difference of two untrusted times, without overflow.
double seconds_between(nanoseconds from, nanoseconds to) {
  return 1e-9 * (static_cast<double>(to.count()) - static_cast<double>(from.count()));
}

}  // namespace

UngatedTwin::UngatedTwin(SimulatedDevice& device, std::shared_ptr<const EffectPlan> plan,
                         const ServoConfig& config)
    : device_(device),
      plan_(std::move(plan)),
      config_(config),
      largest_(device.limits().max_force),
      period_(pdu::to_seconds(config.period)),
      solver_(*plan_, config.contact_radius) {}

void UngatedTwin::step(const HandMotion& real) noexcept {
  if (started_ && real.time <= now_) return;
  const bool skips = started_ && real.time - now_ > kLongestGap;
  const bool begins = skips || !feels();
  now_ = real.time;
  if (!contacts_.frozen) predicted_at_ = now_;
  if (!skips) sample();
  if (!std::exchange(started_, true)) {
    solver_.reset(probe_);
  } else if (begins) {
    begin_anew(real);
    if (!feels()) return;
  }

  Vector3d force = surface_force();
  for (std::size_t i = 0; i < std::min(contacts_.count, kMaxRemoteHands); ++i)
    force += hand_force(contacts_.hands[i]);
  if (is_lost(force, real)) {
    stand_aside();
    return begin_anew(real);
  }
  force_ = force;
  device_.write(config_.device_orientation.conjugate() * force, now_);
}

void UngatedTwin::stand_aside() noexcept {
  ++resets_;
  aside_until_ = now_ + kAside;
  force_.setZero();
}

void UngatedTwin::begin_anew(const HandMotion& real) noexcept {
  const Eigen::Quaterniond from_S = config_.device_orientation.conjugate();
  probe_ = real.position;
  velocity_ = real.velocity;
  force_.setZero();
  device_.restart(from_S * (probe_ - config_.device_origin), from_S * velocity_, now_);
  solver_.reset(probe_);
}

void UngatedTwin::sample() noexcept {
  const DeviceSample reading = device_.read(now_);
  probe_ = config_.device_origin + config_.device_orientation * reading.position;
  velocity_ = config_.device_orientation * reading.velocity;
}

bool UngatedTwin::is_lost(const Vector3d& force, const HandMotion& real) const noexcept {
  // Written so that NaN counts as lost.
  return !(force.norm() <= largest_) || !((probe_ - real.position).norm() <= kFarthest);
}

Vector3d UngatedTwin::surface_force() noexcept {
  ContactResult touched = solver_.step(probe_);
  if (solver_.on_patches())
    touched = solver_.follow_patches(period_, std::numeric_limits<double>::infinity());
  if (touched.objects.empty()) return Vector3d::Zero();
  return touched.force + solver_.effect_force(velocity_, period_);
}

Vector3d UngatedTwin::hand_force(const RemoteHand& hand) const noexcept {
  if (now_ > hand.valid_until) return Vector3d::Zero();
  const double age = seconds_between(hand.state_time, predicted_at_);
  return deadreckon::evaluate(hand.model, deadreckon::extrapolate(hand.state, age), probe_,
                              velocity_, config_.probe_radius);
}

}  // namespace reckon::haptics
