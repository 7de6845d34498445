// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/contact/region_forces.hpp"

#include <algorithm>
#include <cmath>

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;

constexpr double kRiseSeconds = 0.1;
// Energy left for walls, remote hands and held forces while a potential rises [J].
constexpr double kLeft = 0.01;
constexpr double kFar = 1e6;       // [m]
constexpr double kNoJump = 1e-12;  // [J], rounding

double free_energy(const EnergyLedger& ledger) { return std::max(0.0, ledger.level() - kLeft); }

// Range of a device's positions, in a region's axes.
RegionReach reach_of(const PlannedRegion& region, const Eigen::AlignedBox3d& space,
                     const Eigen::Isometry3d& to_scene) {
  RegionReach out;
  Eigen::AlignedBox3d box;
  for (int i = 0; i < 8; ++i) {
    const Vector3d corner = space.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i));
    const Vector3d place = region.orientation.transpose() * (to_scene * corner - region.position);
    box.extend(place);
    out.beyond = std::max(out.beyond, region.beyond(place).norm());
  }
  out.least = box.min();
  out.most = box.max();
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d far = kFar * Vector3d::Unit(axis);
    out.least[axis] = std::max(out.least[axis], (-far - region.beyond(-far))[axis]);
    out.most[axis] = std::min(out.most[axis], (far - region.beyond(far))[axis]);
    if (out.most[axis] < out.least[axis]) out.least[axis] = out.most[axis] = 0.0;
  }
  return out;
}

}  // namespace

RegionForces::RegionForces(const EffectPlan& plan, double stiffness_cap)
    : plan_(plan), cap_(stiffness_cap) {
  states_.reserve(plan.regions().size());
  for (const PlannedRegion& region : plan.regions()) {
    states_.push_back({region.effects, {}});
    region.effects.for_each([&]<class Effect>(const Effect&) {
      if constexpr (LendsRegionEnergy<Effect>) has_sources_ = true;
    });
  }
}

double RegionForces::range(const Eigen::AlignedBox3d& space,
                           const Eigen::Isometry3d& to_scene) const noexcept {
  double sum = 0.0;
  for (const PlannedRegion& region : plan_.regions()) {
    const RegionReach reach = reach_of(region, space, to_scene);
    region.effects.for_each([&]<class Effect>(const Effect& effect) {
      if constexpr (LendsRegionEnergy<Effect>) sum += effect.range(reach);
    });
  }
  return sum;
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
  state.sum = state.source = {};
  const auto add = [](RegionPotential& sum, const RegionPotential& one) {
    sum.energy += one.energy;
    sum.force += one.force;
    sum.stiffness += one.stiffness;
  };
  state.effects.for_each([&]<class Effect>(Effect& effect) {
    if constexpr (StoresRegionEnergy<Effect>) {
      const RegionPotential one = effect.potential(state.point);
      add(state.sum, one);
      if constexpr (LendsRegionEnergy<Effect>) add(state.source, one);
    }
  });
}

void RegionForces::move(const Vector3d& device, EnergyLedger& ledger) noexcept {
  ledger.repay_regions();
  for (std::size_t i = 0; i < states_.size(); ++i) {
    State& state = states_[i];
    const RegionPotential source = state.source;
    const Vector3d place = state.point.place;
    const double before = state.gain * (state.sum.energy - source.energy);
    enter(i, device);
    ledger.book(before - state.gain * (state.sum.energy - state.source.energy));
    if (source.energy > 0 || state.source.energy > 0)
      move(state, source, state.point.place - place, ledger);
  }
}

// Inside, a potential changes by the work of the hand. For any other change, as at an edge, the
// loan for regions pays or is repaid.
void RegionForces::move(State& state, const RegionPotential& before, const Vector3d& way,
                        EnergyLedger& ledger) noexcept {
  const RegionPotential& after = state.source;
  const double stiffness = std::max(before.stiffness, after.stiffness);
  const double by_force =
      (before.energy > 0 && after.energy > 0 ? 0.5 : 1.0) * (before.force + after.force).dot(way);
  const double moved = before.energy > 0 ? std::max(0.0, before.energy - by_force) : 0.0;
  double jump = state.gain * (after.energy - moved);
  if (std::abs(after.energy - moved) <= stiffness * way.squaredNorm() + kNoJump) jump = 0.0;
  ledger.book(state.gain * (before.energy - after.energy));
  if (jump > 0) {
    ledger.book(ledger.region_loan().lend(jump));
  } else if (jump < 0) {
    ledger.region_loan().expect(-jump);
    ledger.repay_regions();
  }
}

Vector3d RegionForces::change() noexcept {
  const Vector3d last = force_;
  sum_up();
  return force_ - last;
}

void RegionForces::settle(double dt, EnergyLedger& ledger) noexcept {
  // Entering a region, or a late sample, may leave a debt.
  for (State& state : states_) {
    const double debt = ledger.debt(), held = state.gain * state.sum.energy;
    if (!(debt > 0)) break;
    if (held > 0) scale_gain(state, debt < held ? 1.0 - debt / held : 0.0, ledger);
  }
  const double most = most_gain();
  share_ = 1.0;
  for (State& state : states_) {
    if (state.gain > most) lower(state, most / state.gain, ledger);
    if (has_sources_) sink(state, dt, ledger);
    if (!raise_gain(state, most, dt, ledger)) share_ = std::min(share_, state.gain / most);
  }
  sum_up();
}

// The active potentials share the cap.
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

void RegionForces::sink(State& state, double dt, EnergyLedger& ledger) noexcept {
  state.point.dt = dt;
  state.effects.for_each([&]<class Effect>(Effect& effect) {
    if constexpr (SinksInRegion<Effect>) {
      if (!(state.gain > 0)) return;
      const double there = ledger.region_loan().room() + free_energy(ledger);
      const RegionPotential rise = effect.sink(state.point, there / state.gain);
      if (!(rise.energy > 0)) return;
      const double cost = state.gain * rise.energy;
      ledger.book(ledger.region_loan().lend(cost) - cost);
      state.sum.energy += rise.energy;
      state.sum.force += rise.force;
      state.source.energy += rise.energy;
      state.source.force += rise.force;
    }
  });
}

// The loan's part of the freed energy is to be repaid.
void RegionForces::lower(State& state, double factor, EnergyLedger& ledger) noexcept {
  ledger.region_loan().expect(state.gain * (1.0 - factor) * state.source.energy);
  scale_gain(state, factor, ledger);
}

// A potential without energy has no force, so its gain is free. The loan for regions pays for the
// regions' part, the ledger for the rest. @return whether nothing is short
bool RegionForces::raise_gain(State& state, double most, double dt, EnergyLedger& ledger) noexcept {
  const double full = state.sum.energy;
  if (!(full > 0)) {
    state.gain = most;
    return true;
  }
  const double wanted = std::clamp(most - state.gain, 0.0, dt / kRiseSeconds);
  const double there = free_energy(ledger), lendable = ledger.region_loan().room();
  const double source = std::min(full, state.source.energy), own = full - source;
  const double by_loan =
      std::min({wanted, source > 0 ? lendable / source : 0.0, own > 0 ? there / own : wanted});
  const double rise = by_loan + std::clamp((there - by_loan * own) / full, 0.0, wanted - by_loan);
  ledger.book(ledger.region_loan().lend(by_loan * source) - rise * full);
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
  shake_.setZero();
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
    Vector3d shake = Vector3d::Zero();
    state.effects.for_each([&]<class Effect>(Effect& effect) {
      if constexpr (ShakesRegion<Effect>) shake += effect.shake(state.point);
    });
    if (!shake.isZero(0.0)) shake_ += axes * shake;
  }
  load.walls += force_;
  load.extra += held_;
  load.shake += shake_;
  shown_ = force_;
}

void RegionForces::attenuate(double factor, EnergyLedger& ledger) noexcept {
  const double keep = std::clamp(factor, 0.0, 1.0);
  for (State& state : states_) lower(state, keep, ledger);
  force_ *= keep;
  shown_ *= keep;
}

}  // namespace reckon::haptics
