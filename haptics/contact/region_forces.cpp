// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/contact/region_forces.hpp"

#include <algorithm>
#include <cmath>

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;

constexpr double kRiseSeconds = 0.1;
// Left to walls, remote hands and held forces while a potential rises [J].
constexpr double kLeft = 0.01;

}  // namespace

RegionForces::RegionForces(const EffectPlan& plan, double stiffness_cap)
    : plan_(plan), cap_(stiffness_cap) {
  states_.reserve(plan.regions().size());
  for (const PlannedRegion& region : plan.regions()) states_.push_back({region.effects, {}});
}

void RegionForces::reset(const Vector3d& device) noexcept {
  begins_ = true;
  for (std::size_t i = 0; i < states_.size(); ++i) {
    states_[i].effects = plan_.regions()[i].effects;
    states_[i].gain = 0.0;
    enter(i, device);
  }
  begins_ = false;
  sum_up();
}

void RegionForces::enter(std::size_t index, const Vector3d& device) noexcept {
  const PlannedRegion& region = plan_.regions()[index];
  State& state = states_[index];
  const bool was_inside = state.point.inside && !begins_;
  state.point.place = region.orientation.transpose() * (device - region.position);
  state.point.beyond = region.beyond(state.point.place);
  state.point.inside = state.point.beyond.isZero(0.0);
  state.point.entered = state.point.inside && !was_inside;
  state.sum = {};
  state.effects.for_each([&]<class Effect>(Effect& effect) {
    if constexpr (StoresRegionEnergy<Effect>) {
      const RegionPotential one = effect.potential(state.point);
      state.sum.energy += one.energy;
      state.sum.force += one.force;
      state.sum.stiffness += one.stiffness;
    }
  });
}

void RegionForces::move(const Vector3d& device, EnergyLedger& ledger) noexcept {
  const double before = stored();
  for (std::size_t i = 0; i < states_.size(); ++i) enter(i, device);
  ledger.book(before - stored());
}

Vector3d RegionForces::change() noexcept {
  const Vector3d last = force_;
  sum_up();
  return force_ - last;
}

void RegionForces::settle(double dt, EnergyLedger& ledger) noexcept {
  // What the hand has entered, or a late sample, may leave a debt.
  for (State& state : states_) {
    const double debt = ledger.debt(), held = state.gain * state.sum.energy;
    if (!(debt > 0)) break;
    if (held > 0) scale_gain(state, debt < held ? 1.0 - debt / held : 0.0, ledger);
  }
  const double most = most_gain();
  share_ = 1.0;
  for (State& state : states_) {
    if (state.gain > most) scale_gain(state, most / state.gain, ledger);
    if (!raise_gain(state, most, dt, ledger)) share_ = std::min(share_, state.gain / most);
  }
  sum_up();
}

// The potentials that the device is in share the cap.
double RegionForces::most_gain() const noexcept {
  double sum = 0.0;
  for (const State& state : states_)
    if (state.sum.energy > 0) sum += state.sum.stiffness;
  return sum > cap_ ? cap_ / sum : 1.0;
}

void RegionForces::scale_gain(State& state, double factor, EnergyLedger& ledger) noexcept {
  ledger.book(state.gain * state.sum.energy * (1.0 - factor));
  state.gain *= factor;
}

// A potential of no energy has no force, so that its gain is free. @return whether nothing is short
bool RegionForces::raise_gain(State& state, double most, double dt, EnergyLedger& ledger) noexcept {
  const double full = state.sum.energy;
  if (!(full > 0)) {
    state.gain = most;
    return true;
  }
  const double wanted = std::clamp(most - state.gain, 0.0, dt / kRiseSeconds);
  const double rise = std::clamp((ledger.level() - kLeft) / full, 0.0, wanted);
  ledger.book(-rise * full);
  state.gain += rise;
  return !(rise < wanted);
}

double RegionForces::stored() const noexcept {
  double sum = 0.0;
  for (const State& state : states_) sum += state.gain * state.sum.energy;
  return sum;
}

void RegionForces::sum_up() noexcept {
  force_.setZero();
  Vector3d whole = Vector3d::Zero();
  const double most = most_gain();
  for (std::size_t i = 0; i < states_.size(); ++i) {
    const Vector3d force = plan_.regions()[i].orientation * states_[i].sum.force;
    force_ += states_[i].gain * force;
    whole += most * force;
  }
  asked_ = whole.norm();
}

void RegionForces::load(const Vector3d& velocity, double dt, PortLoad& load) noexcept {
  held_.setZero();
  for (std::size_t i = 0; i < states_.size(); ++i) {
    const Eigen::Matrix3d& axes = plan_.regions()[i].orientation;
    State& state = states_[i];
    state.point.velocity = axes.transpose() * velocity;
    state.point.dt = dt;
    load.walls_slope += state.gain * state.sum.stiffness;
    load.walls_stored += state.gain * state.sum.energy;
    Vector3d held = Vector3d::Zero();
    state.effects.for_each([&]<class Effect>(Effect& effect) {
      if constexpr (GivesRegionForce<Effect>) held += effect.force(state.point);
    });
    if (held.allFinite()) held_ += axes * held;
  }
  load.walls += force_;
  load.extra += held_;
  shown_ = force_;
}

void RegionForces::attenuate(double factor, EnergyLedger& ledger) noexcept {
  const double keep = std::clamp(factor, 0.0, 1.0);
  for (State& state : states_) scale_gain(state, keep, ledger);
  force_ *= keep;
  shown_ *= keep;
}

}  // namespace reckon::haptics
