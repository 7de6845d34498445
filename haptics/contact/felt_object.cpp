// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/contact/felt_object.hpp"

#include <algorithm>

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;

bool has_follower(const PlannedEffects& effects) {
  bool has = false;
  effects.for_each([&](const auto& effect) { has |= hooks_of(effect).follows; });
  return has;
}

// The object's side of a contact, as input of effects.
ContactedObject seen_of(const PlannedObject& object, const ObjectContact& contact, bool began,
                        double gain) {
  ContactedObject seen;
  seen.place = object.place_of(contact.scp);
  seen.axes = object.orientation;
  seen.triangle = contact.triangle;
  seen.patch = contact.patch;
  seen.began = began;
  seen.gain = gain;
  return seen;
}

}  // namespace

FeltObject::FeltObject(const PlannedEffects& planned, double radius)
    : point(radius), effects(planned), follows(has_follower(planned)) {}

FrictionCone* FeltObject::cone() noexcept {
  FrictionCone* cone = nullptr;
  effects.for_each([&]<class Effect>(Effect& effect) {
    if constexpr (HoldsContactPoint<Effect>) {
      if (hooks_of(effect).holds) cone = &effect.cone();
    }
  });
  return cone;
}

double FeltObject::stiffness() const noexcept {
  double sum = 0.0;
  effects.for_each_spring([&](const auto& effect) { sum += effect.stiffness(); });
  return sum;
}

void FeltObject::restart(const PlannedEffects& planned) noexcept {
  effects = planned;
  touched_at = 0;
  hidden = 0.0;
}

void FeltObject::touch(std::uint64_t step) noexcept {
  began = touched_at == 0 || touched_at + 1 < step;
  touched_at = step;
}

void FeltObject::adjust(const SurfaceFeel& feel) noexcept {
  effects.find<SpringDamper>()->adjust(feel.surface);
  if (auto* friction = effects.find<StickSlipFriction>()) friction->adjust(feel.friction);
}

void FeltObject::follow(const Vector3d& at, bool slid, const ObjectContact& contact, double depth,
                        double dt) noexcept {
  const double pressed = std::max(contact.force.dot(contact.normal), 0.0);
  const double slip = slid ? (at - place).norm() / dt : 0.0;
  const SlidingPlace now{at, slip, dt, pressed, began, depth};
  place = at;
  effects.for_each([&]<class Effect>(Effect& effect) {
    if constexpr (FollowsPlace<Effect>) effect.follow(now);
  });
}

void FeltObject::hold(const PlannedObject& object, const Vector3d& scp, const Vector3d& device,
                      ObjectContact& contact) noexcept {
  held_at = scp;
  contact.in_contact = true;
  contact.force.setZero();
  contact.stored_energy = 0.0;
  const double whole = (scp - device).norm();
  hidden = std::min(hidden, whole);
  contact.depth = whole - hidden;
  const Vector3d end = hidden > 0 ? scp + contact.depth / whole * (device - scp) : device;
  effects.for_each_spring([&](const auto& effect) {
    contact.force += object.orientation * effect.spring_force(scp, end);
    contact.stored_energy += effect.stored_energy(scp, end);
  });
}

void FeltObject::add_forces(const PlannedObject& object, const ObjectContact& contact,
                            EffectContact& seen, double gain, Vector3d& total) noexcept {
  if (!effects.has_declared_forces()) {
    effects.for_each_always([&]<class Effect>(Effect& effect) {
      if constexpr (GivesForce<Effect>) total += effect.force(seen);
    });
    return;
  }
  ContactedObject contacted = seen_of(object, contact, began, gain);
  if (contact.in_contact) seen.object = &contacted;
  if (contact.in_contact && object.is_mesh()) {
    stroke.follow(contacted.place, object.place_of(seen.device),
                  object.orientation.transpose() * seen.normal, contacted.triangle,
                  contacted.began);
    contacted.place = stroke.place();
    seen.normal = object.orientation * stroke.normal();
  }
  effects.for_each([&]<class Effect>(Effect& effect) {
    if constexpr (GivesForce<Effect>) total += effect.force(seen);
  });
}

}  // namespace reckon::haptics
