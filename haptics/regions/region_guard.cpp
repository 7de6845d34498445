// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/regions/region_guard.hpp"

#include <algorithm>
#include <cmath>

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;

constexpr double kTriedTo = 0.1;  // [m], half length of the test paths through the region's origin
constexpr int kTries = 400;
// Rounding of an effect that computes in double precision.
constexpr double kComputed = 1e-6;
constexpr double kExact = 1e-9;      // tolerance of the bound that energy relies on
constexpr double kNoForce = 1e-12;   // [N]
constexpr double kNoEnergy = 1e-12;  // [J]

}  // namespace

GuardedRegionEffect::GuardedRegionEffect(const DeclaredCustomRegionEffect& declared,
                                         const std::string& region)
    : effect_(declared.effect),
      values_(std::make_shared<const std::vector<double>>(declared.values)),
      state_(effect_->make(declared.values)),
      guard_(effect_->key(), region) {
  if (effect_->hooks().stores) try_ways();
}

GuardedRegionEffect::GuardedRegionEffect(const GuardedRegionEffect& other)
    : effect_(other.effect_),
      values_(other.values_),
      state_(other.state_->copy()),
      guard_(other.guard_),
      held_(other.held_) {}

// Findings about the effect's code survive a restart of the servo.
GuardedRegionEffect& GuardedRegionEffect::operator=(const GuardedRegionEffect& other) {
  if (this == &other) return *this;
  if (effect_ != other.effect_) return *this = GuardedRegionEffect(other);
  state_->assign(*other.state_);
  values_ = other.values_;
  guard_ = other.guard_;
  last_ = {};
  return *this;
}

void GuardedRegionEffect::hold_potential() noexcept {
  held_ = true;
  guard_.report().not_booked.store(true, std::memory_order_relaxed);
}

// A non-negative potential of curvature K has no slope above sqrt(2 K energy).
bool GuardedRegionEffect::is_bounded(const RegionPotential& answer) const noexcept {
  const double stiffness = state_->stiffness();
  if (!(stiffness >= 0.0 && stiffness <= kMostStiffness)) return false;
  if (!(answer.stiffness >= 0.0 && answer.stiffness <= (1.0 + kComputed) * stiffness)) return false;
  if (!(answer.energy >= 0.0 && answer.energy <= kMostEnergy)) return false;
  const double steepest = std::sqrt(2.0 * stiffness * answer.energy);
  return answer.force.allFinite() && answer.force.norm() <= (1.0 + kExact) * steepest + kNoForce;
}

// The energy may fall, but grows only by the work of the hand. Along a displacement the force
// changes by at most the stiffness times its length.
bool GuardedRegionEffect::is_earned(const RegionPoint& point,
                                    const RegionPotential& answer) const noexcept {
  if (point.entered || !last_.known) return true;
  const Vector3d way = point.place - last_.place;
  const double given = 0.5 * (last_.answer.force + answer.force).dot(way);
  const double growth = answer.energy - last_.answer.energy;
  const double slack = 0.25 * state_->stiffness() * way.squaredNorm() +
                       kComputed * (std::abs(given) + answer.energy) + kNoEnergy;
  return given + growth <= slack;
}

// Tests the effect with a device that crosses the region's origin along three lines.
void GuardedRegionEffect::try_ways() noexcept {
  const Vector3d ways[] = {Vector3d::UnitX(), Vector3d(-1, 2, 2) / 3, Vector3d(0.6, 0, -0.8)};
  const std::unique_ptr<CustomRegionState> fresh = state_->copy();
  for (const Vector3d& way : ways) {
    state_->assign(*fresh);
    last_ = {};
    for (int i = 0; i <= kTries && !held_; ++i) {
      RegionPoint point;
      point.place = (2.0 * i / kTries - 1.0) * kTriedTo * way;
      point.entered = i == 0;
      const RegionPotential answer = state_->potential(point);
      if (!is_bounded(answer) || !is_earned(point, answer)) hold_potential();
      last_ = {point.place, answer, true};
    }
  }
  state_->assign(*fresh);
  last_ = {};
}

RegionPotential GuardedRegionEffect::potential(const RegionPoint& point) noexcept {
  if (guard_.is_off() || !books()) return {};
  if (!acts_at(point)) {
    last_ = {point.place, {}, true};
    return {};
  }
  return guard_.timed([&]() -> RegionPotential {
    RegionPotential answer = state_->potential(point);
    if (!is_bounded(answer) || !is_earned(point, answer)) {
      hold_potential();
      return {};
    }
    // The stiffness that the check relies on, if any energy is stored.
    if (answer.energy > 0.0) answer.stiffness = state_->stiffness();
    last_ = {point.place, answer, true};
    return answer;
  });
}

double GuardedRegionEffect::stiffness() const noexcept {
  if (!books()) return 0.0;
  const double stiffness = state_->stiffness();
  return stiffness >= 0.0 && stiffness <= kMostStiffness ? stiffness : kMostStiffness;
}

Vector3d GuardedRegionEffect::force(const RegionPoint& point) noexcept {
  if (guard_.is_off() || !acts_at(point)) return Vector3d::Zero();
  return guard_.timed([&]() -> Vector3d {
    Vector3d total = Vector3d::Zero();
    // In the step in which a potential fails, its force has been requested already.
    if (held_) total += guard_.bounded(state_->potential(point).force);
    return total + guard_.bounded(state_->force(point));
  });
}

}  // namespace reckon::haptics
