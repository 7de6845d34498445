// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/contact/contact_solver.hpp"

#include <algorithm>
#include <numeric>

namespace reckon::haptics {

namespace {

using Eigen::Vector3d;

// Far beyond any scene, near enough that no square of it overflows.
constexpr double kFarthest = 1e9;

bool usable(const Vector3d& device) {
  return device.allFinite() && device.cwiseAbs().maxCoeff() <= kFarthest;
}

// What holds the contact point; null for a smooth surface.
FrictionCone* cone_of(PlannedEffects& effects) {
  FrictionCone* cone = nullptr;
  effects.for_each([&]<class Effect>(Effect& effect) {
    if constexpr (HoldsContactPoint<Effect>) cone = &effect.cone();
  });
  return cone;
}

}  // namespace

ContactSolver::ContactSolver(const EffectPlan& plan) : plan_(plan) {
  const std::size_t count = plan.objects().size();
  contacts_.resize(count);
  near_.reserve(count);
  touched_.reserve(count);
  noted_.resize(count);
  states_.reserve(count);
  for (const PlannedObject& object : plan.objects()) states_.push_back({{}, object.effects});
}

ContactResult ContactSolver::reset(const Vector3d& device) noexcept {
  if (!usable(device)) return nothing();
  for (std::size_t i = 0; i < states_.size(); ++i) {
    const PlannedObject& object = plan_.objects()[i];
    ObjectState& state = states_[i];
    contacts_[i] = {};
    contacts_[i].started_inside = state.point.reset(object.shape, object.to_object(device));
    state.effects = object.effects;
    settle(i, device);
  }
  near_.resize(states_.size());
  std::iota(near_.begin(), near_.end(), 0u);
  last_device_ = device;
  started_ = true;
  return sum(device);
}

ContactResult ContactSolver::step(const Vector3d& device) noexcept {
  if (!usable(device)) return nothing();
  if (!started_) return reset(device);
  find_near(device);
  for (const std::uint32_t i : near_) update_object(i, device);
  last_device_ = device;
  return sum(device);
}

// What is touched may be left behind by a way that no longer meets its box, and is to be told.
void ContactSolver::find_near(const Vector3d& device) noexcept {
  ++step_;
  near_.clear();
  const auto note = [this](std::uint32_t index) {
    if (noted_[index] == step_) return;
    noted_[index] = step_;
    near_.push_back(index);
  };
  plan_.visit_near({last_device_.cwiseMin(device), last_device_.cwiseMax(device)}, note);
  for (const std::uint32_t index : touched_) note(index);
  std::sort(near_.begin(), near_.end());
}

// Nothing can have been met when the box of the way from the last device point misses the object.
bool ContactSolver::far_from(const PlannedObject& object, const Vector3d& device) const noexcept {
  return (last_device_.cwiseMin(device).array() > object.bounds.max().array()).any() ||
         (last_device_.cwiseMax(device).array() < object.bounds.min().array()).any();
}

void ContactSolver::update_object(std::size_t index, const Vector3d& device) noexcept {
  const PlannedObject& object = plan_.objects()[index];
  if (!contacts_[index].in_contact) {
    if (far_from(object, device)) {
      contacts_[index].scp = device;
      return;
    }
    states_[index].point.set_free(object.to_object(last_device_));
  }
  settle(index, device);
}

void ContactSolver::settle(std::size_t index, const Vector3d& device) noexcept {
  const PlannedObject& object = plan_.objects()[index];
  ObjectState& state = states_[index];
  const Vector3d local = object.to_object(device);
  state.point.update(object.shape, local, cone_of(state.effects));

  const SurfaceContactPoint& point = state.point;
  ObjectContact& contact = contacts_[index];
  if (!point.in_contact()) {
    contact = {};
    contact.scp = device;
    return;
  }
  contact.in_contact = true;
  contact.scp = object.to_scene(point.scp());
  contact.normal = object.orientation * point.normal();
  contact.depth = (point.scp() - local).norm();
  contact.force.setZero();
  contact.stored_energy = 0.0;
  state.effects.for_each([&]<class Effect>(const Effect& effect) {
    if constexpr (StoresEnergy<Effect>) {
      contact.force += object.orientation * effect.spring_force(point.scp(), local);
      contact.stored_energy += effect.stored_energy(point.scp(), local);
    }
  });
}

Vector3d ContactSolver::effect_force(const Vector3d& velocity, double dt) noexcept {
  Vector3d total = Vector3d::Zero();
  for (const std::uint32_t i : near_) {
    const ObjectContact& contact = contacts_[i];
    const EffectContact seen{last_device_,  contact.scp, contact.normal,    velocity, contact.force,
                             contact.depth, dt,          contact.in_contact};
    states_[i].effects.for_each([&]<class Effect>(Effect& effect) {
      if constexpr (GivesForce<Effect>) total += effect.force(seen);
    });
  }
  return total;
}

ContactResult ContactSolver::sum(const Vector3d& device) noexcept {
  ContactResult result;
  result.scp = device;
  result.objects = contacts_;
  touched_.clear();
  double deepest = -1.0;
  for (const std::uint32_t i : near_) {
    const ObjectContact& contact = contacts_[i];
    result.started_inside |= contact.started_inside;
    if (!contact.in_contact) continue;
    touched_.push_back(i);
    result.in_contact = true;
    result.force += contact.force;
    result.stored_energy += contact.stored_energy;
    if (contact.depth <= deepest) continue;
    deepest = contact.depth;
    result.deepest = i;
    result.scp = contact.scp;
    result.normal = contact.normal;
  }
  result.touched = touched_;
  return result;
}

ContactResult ContactSolver::nothing() const noexcept {
  ContactResult result;
  result.scp = last_device_;
  return result;
}

std::uint64_t ContactSolver::friction_calls() noexcept {
  std::uint64_t calls = 0;
  for (ObjectState& state : states_) {
    const FrictionCone* cone = cone_of(state.effects);
    if (cone != nullptr) calls += cone->calls();
  }
  return calls;
}

}  // namespace reckon::haptics
