// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/bodies/contact_joints.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "reckon/haptics/bodies/rigid_body.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kMostFound = 64;    // contacts of a pair with a mesh
constexpr std::size_t kMostDriven = 256;  // contacts with carried objects whose work is booked
constexpr double kBounceSpeed = 0.01;     // [m/s]; slower hits do not bounce
constexpr double kHitSoftness = 1e-12;
constexpr double kInstantSoftness = 1e-18;
constexpr double kSlipSpeed = 1e-4;  // [m/s]; faster contacts have friction along their slip

// A static or a kinematic body.
bool stands(dBodyID body) noexcept { return body == nullptr || dBodyIsKinematic(body); }

bool sleeps(dBodyID body) noexcept { return body == nullptr || !dBodyIsEnabled(body); }

bool is_carried_on(dBodyID body) noexcept {
  return body != nullptr && dBodyIsKinematic(body) && dBodyIsEnabled(body);
}

// A body of another peer that stands. A joint with it would join all islands that touch it.
bool is_standing_body(dGeomID geom) noexcept {
  const dBodyID body = dGeomGetBody(geom);
  return body != nullptr && dBodyIsKinematic(body) && !dBodyIsEnabled(body) &&
         BodyGeoms::matter_of(geom).matter.mass > 0;
}

Vector3d velocity_at(dBodyID body, const Vector3d& at) noexcept {
  if (body == nullptr) return Vector3d::Zero();
  return vector_of(dBodyGetLinearVel(body)) +
         vector_of(dBodyGetAngularVel(body)).cross(at - vector_of(dBodyGetPosition(body)));
}

// ODE bounds friction along two axes: of a slipping contact one axis is along the slip.
void rub_along(dContact& contact, const Vector3d& velocity) noexcept {
  const Vector3d normal = vector_of(contact.geom.normal);
  const Vector3d slip = velocity - normal.dot(velocity) * normal;
  const double speed = slip.norm();
  if (!(speed > kSlipSpeed)) return;
  contact.surface.mode |= dContactFDir1;
  for (int i = 0; i < 3; ++i) contact.fdir1[i] = slip[i] / speed;
}

}  // namespace

ContactJoints::ContactJoints(dWorldID world, IslandEnergy& energy)
    : world_(world), energy_(energy), joints_(dJointGroupCreate(0)) {
  driven_.reserve(kMostDriven);  // ODE keeps pointers to them
  met_carried_.reserve(kMostDriven);
}

void ContactJoints::clear() noexcept {
  dJointGroupEmpty(joints_);
  islands_.clear();
  driven_.clear();
  met_.clear();
  met_carried_.clear();
}

bool ContactJoints::have_met(dGeomID a, dGeomID b) const noexcept {
  return std::ranges::any_of(
      met_, [&](const auto& pair) { return pair == std::pair(a, b) || pair == std::pair(b, a); });
}

void ContactJoints::meet(dGeomID a, dGeomID b) noexcept {
  const dBodyID first = dGeomGetBody(a), second = dGeomGetBody(b);
  if (sleeps(first) && sleeps(second)) return;
  if (stands(first) && stands(second)) return;
  std::array<dContactGeom, kMostFound> room;
  add(a, b, BodyGeoms::meet(a, b, room));
}

void ContactJoints::add(dGeomID a, dGeomID b, std::span<const dContactGeom> places,
                        Hardness hardness) noexcept {
  if (places.empty()) return;
  met_.emplace_back(a, b);
  const dBodyID first = dGeomGetBody(a), second = dGeomGetBody(b);
  note(a, b, places);
  const Matter &one = BodyGeoms::matter_of(a).matter, &other = BodyGeoms::matter_of(b).matter;
  for (const dContactGeom& place : places) {
    dContact contact{};
    contact.geom = place;
    contact.surface.mode = dContactApprox1 | dContactBounce;
    contact.surface.mu = std::sqrt(one.friction * other.friction);
    contact.surface.bounce = std::max(one.restitution, other.restitution);
    contact.surface.bounce_vel = kBounceSpeed;
    const Vector3d at = vector_of(place.pos);
    const Vector3d velocity = velocity_at(first, at) - velocity_at(second, at);
    rub_along(contact, velocity);
    // A bounce ends within the step.
    if (contact.surface.bounce > 0 &&
        velocity.dot(vector_of(contact.geom.normal)) < -contact.surface.bounce_vel) {
      contact.surface.mode |= dContactSoftCFM;
      contact.surface.soft_cfm = kHitSoftness;
    }
    if (hardness == Hardness::exact) {
      contact.surface.mode |= dContactSoftCFM;
      contact.surface.soft_cfm = kInstantSoftness;
    }
    const dJointID joint = dJointCreateContact(world_, joints_, &contact);
    dJointAttach(joint, is_standing_body(a) ? nullptr : first,
                 is_standing_body(b) ? nullptr : second);
    note_driven(joint, first, second, contact);
  }
}

void ContactJoints::note(dGeomID a, dGeomID b, std::span<const dContactGeom> places) noexcept {
  const dBodyID first = dGeomGetBody(a), second = dGeomGetBody(b);
  const int count = static_cast<int>(places.size());
  double depth = 0.0;
  for (const dContactGeom& place : places) depth = std::max(depth, place.depth);
  const bool are_two = !stands(first) && !stands(second);
  for (const dBodyID body : {first, second}) {
    if (stands(body)) continue;
    energy_.sink(slot_of(body), depth);
    counts_[slot_of(body)] += are_two ? 0.5 * count : count;
  }
  if (are_two) return islands_.join(slot_of(first), slot_of(second), count);
  const bool is_first = !stands(first);
  const std::size_t slot = slot_of(is_first ? first : second);
  islands_.add(slot, count);
  const dBodyID other = is_first ? second : first;
  const bool is_body = BodyGeoms::matter_of(is_first ? b : a).matter.mass > 0;
  if (other != nullptr && is_body && met_carried_.size() < kMostDriven)
    met_carried_.emplace_back(slot, slot_of(other));
  if (!is_carried_on(other)) energy_.pin(slot);
}

void ContactJoints::note_driven(dJointID joint, dBodyID first, dBodyID second,
                                const dContact& contact) noexcept {
  const bool is_second = is_carried_on(first);
  if (!is_second && !is_carried_on(second)) return;
  const Vector3d velocity = velocity_at(is_second ? first : second, vector_of(contact.geom.pos));
  const std::size_t slot = slot_of(is_second ? second : first);
  energy_.drive(slot, (1.0 + contact.surface.bounce) * velocity.norm());
  if (driven_.size() == kMostDriven) return;
  driven_.push_back({slot, is_second, velocity});
  dJointSetFeedback(joint, &driven_.back().force);
}

void ContactJoints::book_driven(double dt) noexcept {
  for (const Driven& one : driven_) {
    const Vector3d force = vector_of(one.is_second ? one.force.f2 : one.force.f1);
    energy_.give(one.slot, dt * force.dot(one.velocity));
  }
}

}  // namespace reckon::haptics
