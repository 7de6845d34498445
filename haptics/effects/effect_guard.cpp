// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/effects/effect_guard.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;
using std::memory_order_relaxed;

constexpr int kDepths = 500;  // depths of the test of a spring at construction
constexpr double kMostFriction = 10.0;
// Rounding of an effect that computes in double precision.
constexpr double kRounding = 1e-6;
constexpr double kExactly = 1e-9;       // tolerance of the bound that energy relies on
constexpr double kLeastForce = 1e-6;    // [N], differences below are rounding
constexpr double kLeastEnergy = 1e-12;  // [J]

bool within(double value, double most) { return value >= 0.0 && value <= most; }

// A spring at one depth along a direction.
struct Sample {
  double force = 0.0;  // towards the contact point [N]
  double energy = 0.0;
  bool usable = false;
};

// A force across the direction, or away from the contact point, does not come from a function of
// the depth. A non-negative function of curvature K has no slope above sqrt(2 K energy).
Sample sample(const CustomEffectState& state, const Vector3d& scp, const Vector3d& way,
              double depth, double stiffness) {
  const Vector3d device = scp + depth * way;
  const Vector3d force = state.spring_force(scp, device);
  const double energy = state.stored_energy(scp, device);
  const double along = -force.dot(way);
  const double steepest = std::sqrt(2.0 * stiffness * std::max(energy, 0.0));
  const bool usable = along <= (1.0 + kExactly) * steepest + kLeastForce && force.allFinite() &&
                      std::isfinite(energy) && energy >= -kLeastEnergy && along >= -kLeastForce &&
                      (force + along * way).norm() <= kLeastForce + kRounding * force.norm();
  return {along, energy, usable};
}

// Whether the energy between two depths is the work of the force, which grows by at most
// `stiffness` [N/m].
bool agree(const Sample& near, const Sample& far, double step, double stiffness) {
  if (!near.usable || !far.usable) return false;
  const double growth = stiffness * step;
  if (std::abs(far.force - near.force) > (1.0 + kRounding) * growth + kLeastForce) return false;
  // Of all such forces, the ones with slope -stiffness and then stiffness have the work farthest
  // from the trapezoidal rule.
  const double work = 0.5 * (near.force + far.force) * step;
  const double slack = 0.25 * growth * step + kRounding * std::abs(work) + kLeastEnergy;
  return std::abs(far.energy - near.energy - work) <= slack;
}

}  // namespace

GuardedEffect::GuardedEffect(const DeclaredCustomEffect& declared, const std::string& object)
    : effect_(declared.effect),
      values_(std::make_shared<const std::vector<double>>(declared.values)),
      state_(effect_->make(declared.values)),
      damping_(state_->damping()),
      guard_(effect_->key(), object) {
  if (!within(damping_, kMostDamping))
    throw std::invalid_argument(effect_->key() + " reserves a damping of " +
                                std::to_string(damping_) + " N s/m: give 0 to 10000");
  if (hooks().stores && !is_potential_up_to(kMostDepth)) hold_spring();
  mend_cone();
}

GuardedEffect::GuardedEffect(const GuardedEffect& other)
    : effect_(other.effect_),
      values_(other.values_),
      state_(other.state_->copy()),
      damping_(other.damping_),
      guard_(other.guard_),
      held_(other.held_) {}

// Findings about the effect's code survive a restart of the contact.
GuardedEffect& GuardedEffect::operator=(const GuardedEffect& other) {
  if (this == &other) return *this;
  if (effect_ != other.effect_) return *this = GuardedEffect(other);
  state_->assign(*other.state_);
  values_ = other.values_;
  guard_ = other.guard_;
  damping_ = other.damping_;
  return *this;
}

void GuardedEffect::hold_spring() const noexcept {
  held_ = true;
  guard_.report().not_booked.store(true, memory_order_relaxed);
}

bool GuardedEffect::is_potential_up_to(double depth) const noexcept {
  const double stiffness = state_->stiffness();
  if (!within(stiffness, kMostStiffness)) return false;
  const double step = depth / kDepths;
  const Vector3d ways[] = {Vector3d::UnitX(), Vector3d(-1, 2, 2) / 3, Vector3d(0.6, 0, -0.8)};
  const Vector3d scp(0.01, -0.02, 0.03);
  Sample before[3];
  for (int i = 0; i <= kDepths; ++i) {
    for (int way = 0; way < 3; ++way) {
      const Sample now = sample(*state_, scp, ways[way], i * step, stiffness);
      if (!now.usable || (i > 0 && !agree(before[way], now, step, stiffness))) return false;
      before[way] = now;
    }
    const auto [least, most] = std::minmax({before[0].energy, before[1].energy, before[2].energy});
    if (most - least > kRounding * most + kLeastEnergy) return false;
  }
  return true;
}

bool GuardedEffect::is_potential_about(const Vector3d& scp, const Vector3d& device) const noexcept {
  const double depth = (device - scp).norm();
  const double stiffness = state_->stiffness();
  if (!within(stiffness, kMostStiffness)) return false;
  if (!(depth > 0.0)) return true;
  const Vector3d way = (device - scp) / depth;
  const double step = std::min(1e-4, depth);
  const Sample before = sample(*state_, scp, way, depth - step, stiffness);
  const Sample now = sample(*state_, scp, way, depth, stiffness);
  const Sample after = sample(*state_, scp, way, depth + step, stiffness);
  return agree(before, now, step, stiffness) && agree(now, after, step, stiffness);
}

// The contact point follows the cone, so a coefficient of NaN would lose it.
void GuardedEffect::mend_cone() noexcept {
  FrictionCone* cone = state_->cone();
  if (cone == nullptr) return;
  const double at_rest = cone->at_rest(), kinetic = cone->kinetic();
  if (within(at_rest, kMostFriction) && within(kinetic, at_rest)) return;
  guard_.report().not_finite.fetch_add(1, memory_order_relaxed);
  cone->adjust(0.0, 0.0);
}

void GuardedEffect::follow(const SlidingPlace& place) noexcept {
  if (guard_.is_off()) return;
  guard_.timed([&] { state_->follow(place); });
  mend_cone();
}

Vector3d GuardedEffect::spring_force(const Vector3d& scp, const Vector3d& device) const noexcept {
  if (guard_.is_off() || !books()) return Vector3d::Zero();
  return guard_.timed([&]() -> Vector3d {
    if (is_potential_about(scp, device)) return state_->spring_force(scp, device);
    hold_spring();
    return Vector3d::Zero();
  });
}

double GuardedEffect::stored_energy(const Vector3d& scp, const Vector3d& device) const noexcept {
  if (!books()) return 0.0;
  return guard_.timed([&] { return std::max(0.0, state_->stored_energy(scp, device)); });
}

// Plans call it too, from many threads, so it changes nothing. Its time counts in
// is_potential_about().
double GuardedEffect::stiffness() const noexcept {
  if (!books()) return 0.0;
  const double stiffness = state_->stiffness();
  return within(stiffness, kMostStiffness) ? stiffness : kMostStiffness;
}

Vector3d GuardedEffect::force(const EffectContact& contact) noexcept {
  if (guard_.is_off()) return Vector3d::Zero();
  Vector3d total = Vector3d::Zero();
  // A velocity-dependent effect declares its coefficient.
  const double most = contact.most_viscosity;
  const double share = contact.in_contact && damping_ > most ? most / damping_ : 1.0;
  guard_.timed([&] {
    total += share * guard_.bounded(state_->force(contact));
    if (held_ && contact.in_contact)
      total += guard_.bounded(state_->spring_force(contact.scp, contact.device));
  });
  mend_cone();
  return total;
}

}  // namespace reckon::haptics
