// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/baselines/reckon_end.hpp"

#include <algorithm>
#include <cmath>

#include "reckon/pdu/seconds.hpp"

namespace reckon::bench {
namespace {

using std::chrono::nanoseconds;

constexpr double kMostForce = 100.0;  // [N], of the study's devices
constexpr double kEndless = 1e9;      // [N s/m], damping of a device without the gate
constexpr nanoseconds kHandValidity = std::chrono::milliseconds(720);
constexpr nanoseconds kServerValidity = std::chrono::hours(1);

double cap_of(const CouplingEndConfig& config) {
  const double whole = haptics::ServoConfig{}.stiffness_share * 2 * config.damping / config.period;
  return config.counterpart == Counterpart::hand ? 0.5 * whole : whole;
}

haptics::DeviceLimits limits_of(const CouplingEndConfig& config) {
  haptics::DeviceLimits limits;
  limits.max_force = kMostForce;
  limits.max_speed = 2.0;
  limits.damping = config.gate ? config.damping : kEndless;
  limits.max_stiffness = config.gate ? 0.0 : cap_of(config);
  return limits;
}

haptics::ServoConfig servo_of(const CouplingEndConfig& config) {
  haptics::ServoConfig servo;
  servo.period = pdu::from_seconds(config.period);
  servo.probe_radius = 0.0;
  servo.max_force_rate = servo.stiffness_share * 2 * config.damping / config.period;
  return servo;
}

haptics::RemoteHand other_of(const CouplingEndConfig& config) {
  haptics::RemoteHand other;
  const bool first = config.side == CouplingSide::first;
  other.id = {1, 1, static_cast<std::uint16_t>(first ? 2 : 1)};
  other.model.kind = pdu::ForceModelKind::plane;
  other.model.normal = (first ? -1.0 : 1.0) * Eigen::Vector3d::UnitX();
  other.has_device = config.counterpart == Counterpart::hand;
  if (other.has_device) other.state.algorithm = pdu::DeadReckoningAlgorithm::fpw;
  return other;
}

}  // namespace

void StudyHandle::move(double position, double velocity) noexcept {
  sample_.position.x() = position;
  sample_.velocity.x() = velocity;
  sample_.has_velocity = true;
  sample_.ok = true;
}

haptics::DeviceSample StudyHandle::read(nanoseconds) noexcept { return sample_; }

void StudyHandle::write(const Eigen::Vector3d& force, nanoseconds) noexcept { force_ = force.x(); }

ReckonEnd::ReckonEnd(const CouplingEndConfig& config)
    : config_(config),
      handle_(limits_of(config)),
      servo_(handle_, haptics::EffectPlan(), servo_of(config)) {
  set_.hands[0] = other_of(config);
}

nanoseconds ReckonEnd::time_of(std::uint32_t number) const noexcept {
  return pdu::from_seconds((number + 1.0) * config_.period);
}

double ReckonEnd::step(const OwnMotion& own, std::span<const CouplingSample> arrived) noexcept {
  number_ = own.number;
  for (const CouplingSample& sample : arrived) take(sample);
  handle_.move(own.position, own.velocity);
  servo_.step(time_of(own.number));
  servo_.snapshots().update();
  loan_ = servo_.snapshots().read().loan;
  return handle_.force();
}

// As in the model loop: the newest wins.
void ReckonEnd::take(const CouplingSample& sample) noexcept {
  haptics::RemoteHand& other = set_.hands[0];
  if (sample.number + 1 <= other.version) return;
  const bool is_hand = config_.counterpart == Counterpart::hand;
  other.version = sample.number + 1;
  other.state.position.x() = sample.position;
  other.state.velocity.x() = sample.velocity;
  other.state_time = time_of(sample.number);
  other.valid_until = other.state_time + (is_hand ? kHandValidity : kServerValidity);
  other.model.k1 = sample.stiffness;
  other.given_to_us = sample.given;
  other.need = sample.need;
  other.spring_need = sample.spring_need;
  const bool exchanges = sample.given > 0 || sample.need > 0 || sample.spring_need > 0;
  other.neighbours = exchanges ? 1 : 0;
  set_.count = 1;
  servo_.contacts().write(set_);
}

CouplingSample ReckonEnd::sample() noexcept {
  const haptics::ServoSnapshot& s = servo_.snapshots().read();
  CouplingSample out;
  out.number = number_;
  out.position = s.device.x();
  out.velocity = s.device_velocity.x();
  out.stiffness = config_.environment.stiffness() * s.softening;
  if (s.count > 0) {
    out.given = s.contacts[0].given;
    out.need = s.contacts[0].need;
    out.spring_need = s.contacts[0].spring_need;
  }
  return out;
}

}  // namespace reckon::bench
