// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/devices/simulated_turn.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace reckon::haptics {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

Vector3d turn_of(const Quaterniond& rotation) noexcept {
  const Eigen::AngleAxisd turn(rotation);
  return turn.angle() * turn.axis();
}

Quaterniond rotation_by(const Vector3d& turn) noexcept {
  const double angle = turn.norm();
  if (!(angle > 0)) return Quaterniond::Identity();
  return Quaterniond(Eigen::AngleAxisd(angle, turn / angle));
}

}  // namespace

void require_of_simulated(bool good, const char* what, double value) {
  if (good) return;
  throw std::invalid_argument(std::string("simulated device: ") + what + ", got " +
                              std::to_string(value));
}

SimulatedTurn::SimulatedTurn(const SimulatedTurnConfig& config)
    : config_(config), orientation_(config.start.normalized()) {
  require_of_simulated(config.inertia > 0, "inertia must be above 0 kg m^2", config.inertia);
  require_of_simulated(config.damping > 0, "damping of rotation must be above 0 N m s/rad",
                       config.damping);
  require_of_simulated(config.hand_stiffness >= 0,
                       "rotational hand stiffness must be 0 or more N m/rad",
                       config.hand_stiffness);
  require_of_simulated(config.hand_damping >= 0,
                       "rotational hand damping must be 0 or more N m s/rad", config.hand_damping);
  require_of_simulated(config.max_torque > 0, "largest torque must be above 0 N m",
                       config.max_torque);
  require_of_simulated(config.resolution >= 0, "angular resolution must be 0 or more rad",
                       config.resolution);
}

Quaterniond SimulatedTurn::reading() const noexcept {
  const double step = config_.resolution;
  if (!(step > 0)) return orientation_;
  return rotation_by((turn_of(orientation_) / step).array().round().matrix() * step);
}

void SimulatedTurn::restart(const Quaterniond& orientation, const Vector3d& rate) noexcept {
  orientation_ = orientation;
  rate_ = rate;
  port_work_ = damping_loss_ = hand_work_ = 0.0;
}

void SimulatedTurn::step(const Vector3d& torque, const Quaterniond& target,
                         const Vector3d& target_rate, double grip, double h) noexcept {
  const Vector3d to_target = turn_of(target * orientation_.conjugate());
  const Vector3d hand =
      grip * (config_.hand_stiffness * to_target + config_.hand_damping * (target_rate - rate_));
  rate_ += h / config_.inertia * (hand + torque - config_.damping * rate_);
  const Vector3d turn = h * rate_;
  orientation_ = (rotation_by(turn) * orientation_).normalized();
  port_work_ -= torque.dot(turn);
  hand_work_ += hand.dot(turn);
  damping_loss_ += config_.damping * rate_.dot(turn);
}

}  // namespace reckon::haptics
