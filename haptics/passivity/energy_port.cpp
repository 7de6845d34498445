// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/passivity/energy_port.hpp"

#include <algorithm>
#include <cmath>

namespace reckon::haptics {
namespace {

constexpr double kMostGift = 0.9;  // of what there is
constexpr int kHalvings = 20;

}  // namespace

void EnergyPort::settle(const Eigen::Vector3d& dx, double dt) noexcept {
  level_ += damping_ * dx.squaredNorm() / dt - held_.dot(dx);
}

double EnergyPort::credit(double energy) noexcept {
  const double room = std::max(0.0, limit_ + booked_ - std::max(0.0, level_));
  const double fits = energy > 0 ? std::min(energy, room) : 0.0;
  level_ += fits;
  return fits;
}

double EnergyPort::credit(double energy, double seen) noexcept {
  const double fits = credit(std::min(energy, seen + unseen_));
  unseen_ -= std::max(0.0, fits - seen);
  return fits;
}

void EnergyPort::wait(double dt) noexcept {
  unseen_ = std::min(kUnseen, unseen_ + kUnseenPower * dt);
}

double EnergyPort::give(double wanted) noexcept {
  const double gift = wanted > 0 ? std::min(kMostGift * std::max(0.0, level_), wanted) : 0.0;
  level_ -= gift;
  return gift;
}

void EnergyPort::borrow(double energy) noexcept {
  level_ += energy;
  owed_ += energy;
}

void EnergyPort::pay_back(double energy) noexcept {
  const double paid = std::clamp(energy, 0.0, owed_);
  level_ -= paid;
  owed_ -= paid;
}

void EnergyPort::clear() noexcept {
  level_ = booked_ = 0.0;
  held_.setZero();
}

SplitBound EnergyPort::bound_of(const PortLoad& load, double dt) const noexcept {
  SplitBound bound;
  bound.energy = std::max(0.0, level_);
  bound.stored = load.stored;
  bound.springs = load.springs;
  bound.spare = damping_ / dt - 0.5 * load.walls_slope;
  bound.half_slope = 0.5 * load.springs_slope;
  return bound;
}

PortHold EnergyPort::hold(const PortLoad& load, double dt) noexcept {
  PortHold out;
  const SplitBound bound = bound_of(load, dt);
  const auto with_extra = [&](double share) {
    return largest_weight(bound, load.springs + share * load.extra);
  };
  auto weight = with_extra(1.0);
  if (!weight) {
    // What belongs to no storage gives way first.
    weight = with_extra(0.0);
    out.extra = 0.0;
    double high = 1.0;
    for (int i = 0; weight && i < kHalvings; ++i) {
      const double middle = 0.5 * (out.extra + high);
      const auto there = with_extra(middle);
      (there ? out.extra : high) = middle;
      if (there) weight = there;
    }
  }
  if (weight) {
    out.weight = *weight;
  } else {
    const Strongest most = strongest(bound);
    out.weight = most.weight;
    out.springs = most.share;
  }
  booked_ = out.weight * load.stored;
  const Eigen::Vector3d shown = out.springs * load.springs + out.extra * load.extra;
  const double rest = (shown - out.weight * load.springs).squaredNorm();
  const double pays = bound.spare - out.weight * bound.half_slope;
  const double reserved = rest > 0 ? rest / (4.0 * pays) : 0.0;
  level_ = std::min(level_, booked_ + std::max(limit_, reserved));
  held_ = out.force = load.walls + shown;
  return out;
}

bool EnergyPort::hold_instead(const PortLoad& load, const Eigen::Vector3d& force,
                              double dt) noexcept {
  const auto weight = largest_weight(bound_of(load, dt), force - load.walls);
  if (!weight) return false;
  booked_ = *weight * load.stored;
  held_ = force;
  return true;
}

}  // namespace reckon::haptics
