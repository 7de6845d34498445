// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/servo/servo_core.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "reckon/haptics/servo/coefficient_step.hpp"
#include "reckon/haptics/servo/servo_limits.hpp"
#include "reckon/haptics/servo/servo_step.hpp"
#include "reckon/pdu/seconds.hpp"

namespace reckon::haptics {
namespace {

constexpr double kSafeSpeed = 1.0;  // [m/s], of impact on the stiffest wall, or of a yielding hand

}  // namespace

ServoCore::ServoCore(HapticDevice& device, std::shared_ptr<const EffectPlan> plan,
                     const ServoConfig& config, std::shared_ptr<BodyWorld> bodies)
    : device_(device),
      limits_(checked_limits(device.limits())),
      config_(checked_config(config, limits_)),
      plan_(checked_plan(std::move(plan))),
      bodies_(checked_bodies(std::move(bodies), *plan_, config_)),
      period_(pdu::to_seconds(config.period)),
      stiffness_per_damping_(stiffness_per_damping(config_, limits_)),
      stop_(config_.stop, config_.stop_button) {
  step_.period = period_;
  step_.probe_radius = config_.probe_radius;
  step_.force_limit = std::min(limits_.max_force, config_.max_force);
}

double ServoCore::cap_for(double probe, double tool, double bend) noexcept {
  static_cap_ = static_cap(*plan_, config_, limits_, tool, stiffness_per_damping_) - bend * tool;
  max_rate_ = std::min(config_.max_force_rate, stiffness_per_damping_ * tool * kSafeSpeed);
  max_power_ = std::min(config_.max_power, limits_.max_force * kSafeSpeed);
  const auto shown = [&](double cap) {
    return limits_.max_stiffness > 0 ? std::min(cap, limits_.max_stiffness) : cap;
  };
  step_.stiffness_limit = remote_cap_ = shown(0.5 * stiffness_per_damping_ * probe);
  step_.body_stiffness_limit = body_cap_ = shown(stiffness_per_damping_ * probe);
  step_.damping = probe;
  return static_cap_;
}

void ServoCore::use_damping(double damping) noexcept {
  const double share = limits_.damping > 0 ? damping / limits_.damping : 1.0;
  step_.stiffness_limit = share * remote_cap_;
  step_.body_stiffness_limit = share * body_cap_;
  step_.damping = damping;
}

// A sample shorter than the real one would credit too much damping.
void ServoCore::note_time() noexcept {
  if (count_ > 0 && 2 * (step_.now - stepped_at_) > 3 * config_.period) ++tally_.late;
  elapsed_ =
      count_ > 0 ? std::max(pdu::to_seconds(step_.now - stepped_at_), 0.1 * period_) : period_;
  stepped_at_ = step_.now;
}

void ServoCore::obey_stop(DeviceSample& reading) noexcept {
  const bool was_stopped = stopped_;
  stopped_ = stop_.look(reading, step_.now);
  if (!stopped_) return;
  if (!was_stopped) ++tally_.stops;
  reading.enabled = false;
  tally_.stopped += elapsed_;
}

bool ServoCore::take_news(double moved) noexcept {
  constexpr std::chrono::milliseconds kStillFor{100}, kAtLeast{10};
  const bool moves = has_near() || !((step_.probe - seen_at_).norm() <= moved);
  if (moves) {
    seen_at_ = step_.probe;
    moved_ = step_.now;
  }
  const bool is_new = step_.now - moved_ < kStillFor || step_.now - seen_ >= kAtLeast;
  if (is_new) seen_ = step_.now;
  return is_new;
}

std::unique_ptr<ServoCore> make_servo(HapticDevice& device, std::shared_ptr<const EffectPlan> plan,
                                      const ServoConfig& config,
                                      std::shared_ptr<BodyWorld> bodies) {
  if (device.limits().kind == DeviceKind::coefficients) {
    auto* const springs = dynamic_cast<CoefficientDevice*>(&device);
    if (springs == nullptr)
      throw std::invalid_argument(
          "servo: a device of kind coefficients must be a CoefficientDevice");
    return std::make_unique<CoefficientStep>(*springs, std::move(plan), config, std::move(bodies));
  }
  if (device.limits().axes == 6)
    return std::make_unique<ServoStepOf<6>>(device, std::move(plan), config, std::move(bodies));
  return std::make_unique<ServoStepOf<3>>(device, std::move(plan), config, std::move(bodies));
}

}  // namespace reckon::haptics
