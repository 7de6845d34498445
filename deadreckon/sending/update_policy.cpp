// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/deadreckon/sending/update_policy.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "reckon/deadreckon/motion/acceleration_trust.hpp"
#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/deadreckon/motion/rotation.hpp"

namespace reckon::deadreckon {

namespace {

constexpr double kQuick = 5.0;      // air, space and munitions [s]
constexpr double kPlatform = 55.0;  // land and sea [s]
constexpr double kSlow = 60.0;      // life forms and fixed objects [s]
constexpr double kJitter = 0.1;     // in each direction

double platform_heartbeat(pdu::EntityDomain domain) {
  switch (domain) {
    case pdu::EntityDomain::land:
    case pdu::EntityDomain::surface:
    case pdu::EntityDomain::subsurface:
      return kPlatform;
    default:
      return kQuick;
  }
}

}  // namespace

std::string_view name(SendReason reason) noexcept {
  constexpr std::array<std::string_view, 7> kNames = {
      "none", "first", "event", "position", "orientation", "force", "heartbeat"};
  const auto row = static_cast<std::size_t>(reason);
  return row < kNames.size() ? kNames[row] : "unknown";
}

double nominal_heartbeat(const pdu::EntityType& type, bool stationary) noexcept {
  if (stationary) return kSlow;
  switch (type.kind) {
    case pdu::EntityKind::platform:
      return platform_heartbeat(type.domain);
    case pdu::EntityKind::life_form:
    case pdu::EntityKind::environmental:
    case pdu::EntityKind::cultural_feature:
      return kSlow;
    default:
      return kQuick;
  }
}

double jittered_heartbeat(double nominal, const pdu::EntityId& id) noexcept {
  constexpr std::size_t kSteps = 4096;
  const auto step = static_cast<double>(std::hash<pdu::EntityId>{}(id) % kSteps);
  return nominal * (1.0 + kJitter * (2.0 * step / (kSteps - 1) - 1.0));
}

HeartbeatGrid heartbeat_grid(double nominal, const pdu::SimulationAddress& owner) noexcept {
  const pdu::EntityId of_peer{owner.site, owner.application, 0};
  const double step = kJitter * nominal;
  return {step, step * (jittered_heartbeat(1.0, of_peer) - (1.0 - kJitter)) / (2.0 * kJitter)};
}

SendReason UpdatePolicy::decide(const Pose& truth, double now, double force_error,
                                double true_force) const noexcept {
  if (!is_finite(truth)) return SendReason::none;
  if (!has_sent_) return SendReason::first;
  if (event_) return SendReason::event;

  SendReason reason = error_of(extrapolate(sent_, now - sent_time_), truth);
  if (reason == SendReason::none && is_beyond_trust(sent_, now - sent_time_))
    reason = error_of(predicted(now), truth);
  if (reason == SendReason::none && next_look_ > 0) reason = error_until(now + next_look_);
  if (reason != SendReason::none) return reason;
  const double force = std::max(thresholds_.force, thresholds_.weber * true_force);
  if (!(force_error <= force)) return SendReason::force;
  return now - sent_time_ >= wait_ ? SendReason::heartbeat : SendReason::none;
}

// The kind of error that is above its threshold, between the shown and the true pose. Conditions
// are negated, so that a NaN prediction is corrected too.
SendReason UpdatePolicy::error_of(const Pose& seen, const Pose& truth) const noexcept {
  const PoseError error{truth.position - seen.position, truth.velocity};
  if (!(rule_->share(error, thresholds_) <= 1)) return SendReason::position;
  const double angle = angle_between(truth.orientation, seen.orientation);
  return angle <= thresholds_.angle ? SendReason::none : SendReason::orientation;
}

// Whether at time `next` the prediction of Reckon peers will differ from the standard's by more
// than a threshold. The standard's prediction is within the thresholds now.
SendReason UpdatePolicy::error_until(double next) const noexcept {
  if (!is_beyond_trust(sent_, next - sent_time_)) return SendReason::none;
  return error_of(predicted(next), extrapolate(sent_, next - sent_time_));
}

void UpdatePolicy::sent(const KinematicState& as_received, double now, SendReason reason) noexcept {
  const bool is_event = reason == SendReason::event || reason == SendReason::first;
  const double next = 2.0 * std::max(wait_, first_heartbeat_);
  wait_ = is_event ? event_repeat_ : first_heartbeat_;
  if (reason == SendReason::heartbeat) wait_ = std::min(next, heartbeat_);
  if (step_ > 0 && wait_ >= heartbeat_) wait_ = aligned(now);
  sent_ = as_received;
  sent_time_ = now;
  has_sent_ = true;
  event_ = false;
}

// Time from now until the last multiple of the step before the heartbeat is due, less a margin for
// rounding.
double UpdatePolicy::aligned(double now) const noexcept {
  constexpr double kRounding = 1e-6;  // [s]
  const double moment = std::floor((now + heartbeat_ - phase_) / step_) * step_ + phase_;
  return std::clamp(moment - now, heartbeat_ - step_, heartbeat_) - kRounding;
}

Pose UpdatePolicy::predicted(double now) const noexcept {
  return extrapolate_trusted(sent_, now - sent_time_);
}

}  // namespace reckon::deadreckon
