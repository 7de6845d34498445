// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/contact/grab.hpp"

#include <algorithm>

namespace reckon::haptics {

using Eigen::Vector3d;

namespace {

constexpr double kGrabRamp = 0.1;
constexpr double kLeastGain = 0.01;

}  // namespace

void Grab::take(std::size_t body, const GrabSpring& spring, const Vector3d& probe,
                const ObjectMotion& motion) noexcept {
  *this = {};
  holds_ = true;
  body_ = body;
  spring_ = spring;
  motion_ = motion;
  place_ = motion.orientation.conjugate() * (probe - motion.position);
}

void Grab::stiffen(double stiffness, EnergyLedger& ledger) noexcept {
  if (!holds_ || stiffness == spring_.stiffness) return;
  const double before = booked(), factor = stiffness / spring_.stiffness;
  spring_.stiffness = stiffness;
  force_ *= factor;
  stored_ *= factor;
  lent_ *= factor;
  ledger.book(before - booked());
}

void Grab::release(EnergyLedger& ledger) noexcept {
  if (!holds_) return;
  // The energy lent for the body's motion is no storage.
  ledger.book(-gain_ * lent_);
  *this = {};
}

Vector3d Grab::move(const Vector3d& probe, EnergyLedger& ledger) noexcept {
  if (!holds_) return Vector3d::Zero();
  const double before = booked();
  const Vector3d force = force_;
  const Vector3d stretch = probe - point();
  force_ = -spring_.stiffness * stretch;
  stored_ = 0.5 * spring_.stiffness * stretch.squaredNorm();
  // The velocity of a body lags its position by half a step; see WallContact.
  lent_ = 0.5 * motion_.step * force_.dot(point_velocity());
  ledger.book(before - booked());
  return gain_ * (force_ - force);
}

void Grab::settle(double dt, EnergyLedger& ledger) noexcept {
  if (!holds_) return;
  const double debt = ledger.debt();
  if (debt > 0) scale_gain(debt < booked() ? 1.0 - debt / booked() : 0.0, ledger);
  if (gain_ < kLeastGain) return release(ledger);
  const double wanted = std::min(1.0 - gain_, dt / kGrabRamp);
  const double rise = stored_ > 0 ? std::clamp(ledger.level() / stored_, 0.0, std::max(0.0, wanted))
                                  : std::max(0.0, wanted);
  ledger.book(-rise * (stored_ - lent_));
  gain_ += rise;
}

void Grab::scale_gain(double factor, EnergyLedger& ledger) noexcept {
  ledger.book(booked() * (1.0 - factor));
  gain_ *= factor;
}

void Grab::load(PortLoad& load) const noexcept {
  if (!holds_) return;
  load.walls += spring_force();
  load.walls_slope += stiffness();
  load.walls_stored += gain_ * stored_;
  load.extra += change_;
}

void Grab::attenuate(double factor, EnergyLedger& ledger) noexcept {
  if (holds_) scale_gain(std::clamp(factor, 0.0, 1.0), ledger);
}

}  // namespace reckon::haptics
