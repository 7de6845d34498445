// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/bodies/body_slots.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "reckon/haptics/bodies/body_geoms.hpp"
#include "reckon/haptics/bodies/body_mass.hpp"
#include "reckon/haptics/bodies/body_world.hpp"

namespace reckon::haptics {
namespace {

static_assert(BodySlots::kMost == BodyWorld::kMostActive);

using Eigen::Vector3d;

constexpr double kEffort = 6e-4;  // cost of a step for a mesh corner, over a box
constexpr const char* kTooManyCarried =
    "the scene has bodies and more than 64 objects below nodes that move by functions of time: "
    "remove the mass of the bodies, or some of those objects";

}  // namespace

BodySlots::~BodySlots() {
  for (const BodyKind& kind : kinds_)
    if (kind.geom != nullptr && dGeomGetSpace(kind.geom) == nullptr) dGeomDestroy(kind.geom);
}

void BodySlots::add(const PlannedObject& object, std::uint32_t number, dGeomID geom) {
  BodyKind& kind = kinds_.emplace_back();
  kind.geom = geom;
  kind.number = kinds_.size() - 1;
  kind.object = number;
  kind.is_carried = object.carried;
  kind.can_be_owned = object.is_body();
  if (kind.can_be_owned) {
    const ProbedMesh* mesh = BodyGeoms::matter_of(geom).mesh;
    if (mesh != nullptr) kind.effort += kEffort * static_cast<double>(mesh->corners().size());
    const BodyMass given = mass_of(object, mesh != nullptr ? &mesh->mesh() : nullptr);
    kind.whole_mass = object.matter.mass;
    kind.mass = kind.is_carried ? 0.0 : kind.whole_mass;
    kind.drag = object.matter.drag;
    kind.inner = given.inner;
    kind.least_inertia = given.least_inertia;
    kind.middle = given.middle;
    kind.inertia = given.mass;
  }
  kind.orientation = object.orientation;
  kind.at = kind.start = object.position + object.orientation * kind.middle;
}

void BodySlots::fill() {
  const bool all_fit = kinds_.size() <= kMost;
  slot_of_.assign(kinds_.size(), kNone);
  bodies_.reserve(kMost);
  asleep_ = CellGrid(all_fit ? 0 : kinds_.size());
  for (const BodyKind& kind : kinds_) {
    if (all_fit || !(kind.whole_mass > 0)) {
      if (bodies_.size() == kMost) throw std::invalid_argument(kTooManyCarried);
      take_in(kind.number, 0);
    } else {
      dSpaceRemove(space_, kind.geom);
      lie_down(kind);
    }
  }
}

std::size_t BodySlots::take_in(std::size_t body, BodySet pinned) noexcept {
  if (slot_of_[body] != kNone) return slot_of_[body];
  std::size_t slot = bodies_.size();
  if (slot < kMost) {
    bodies_.emplace_back().id = dBodyCreate(world_);
    dBodySetData(bodies_.back().id, reinterpret_cast<void*>(slot));
  } else {
    const auto stays = [&](std::size_t i) {
      return (pinned >> i & 1) != 0 || !(bodies_[i].whole_mass > 0) || bodies_[i].is_awake();
    };
    std::size_t tried = 0;
    for (; tried < kMost && stays(next_out_); ++tried) next_out_ = (next_out_ + 1) % kMost;
    if (tried == kMost) return kNone;
    slot = next_out_;
    next_out_ = (next_out_ + 1) % kMost;
    leave(slot);
  }
  sit(slot, kinds_[body]);
  return slot;
}

void BodySlots::sit(std::size_t slot, const BodyKind& kind) noexcept {
  RigidBody& body = bodies_[slot];
  static_cast<BodyKind&>(body) = kind;
  slot_of_[kind.number] = slot;
  body.clear_since = 0;
  const bool was_asleep = kind.geom != nullptr && dGeomGetSpace(kind.geom) == nullptr;
  if (was_asleep) {
    asleep_.remove(static_cast<std::uint32_t>(kind.number));
    asleep_energy_ -= kind.height_energy(kind.at, gravity_);
    dSpaceAdd(space_, kind.geom);
  }
  body.island = slot;
  set_mode(slot);
  if (kind.geom != nullptr) dGeomSetBody(kind.geom, body.id);
  const Vector3d& m = kind.middle;
  if (!m.isZero(0.0)) dGeomSetOffsetPosition(kind.geom, -m.x(), -m.y(), -m.z());
  RigidBody::State state;
  std::ranges::copy(kind.at, state.at.begin());
  state.turned = {kind.orientation.w(), kind.orientation.x(), kind.orientation.y(),
                  kind.orientation.z()};
  state.awake = !kind.is_carried && !was_asleep;
  state.account = kind.account;
  body.set(state);
  dBodySetMaxAngularSpeed(body.id, BodyWorld::kFastestTurn);
}

void BodySlots::set_mode(std::size_t slot) noexcept {
  const RigidBody& body = bodies_[slot];
  const BodySet one = BodySet{1} << slot;
  if (body.is_carried) {
    carried_ |= one;
    dBodySetKinematic(body.id);
  } else {
    carried_ &= ~one;
    dBodySetMass(body.id, &body.inertia);
  }
}

void BodySlots::set_carried(std::size_t number, bool is_carried) noexcept {
  BodyKind& kind = kinds_[number];
  const std::size_t slot = slot_of_[number];
  const auto change = [is_carried](BodyKind& of) {
    of.is_carried = is_carried;
    of.mass = is_carried ? 0.0 : of.whole_mass;
    of.account = 0.0;
  };
  if (slot == kNone) asleep_energy_ -= kind.height_energy(kind.at, gravity_);
  change(kind);
  if (slot == kNone) {
    asleep_energy_ += kind.height_energy(kind.at, gravity_);
    return;
  }
  change(bodies_[slot]);
  bodies_[slot].still = bodies_[slot].lag = 0.0;
  set_mode(slot);
}

void BodySlots::lie(std::size_t body, const ObjectMotion& at) noexcept {
  BodyKind& kind = kinds_[body];
  asleep_energy_ -= kind.height_energy(kind.at, gravity_);
  kind.orientation = at.orientation;
  kind.at = at.position + at.orientation * kind.middle;
  lie_down(kind);
}

void BodySlots::leave(std::size_t slot) noexcept {
  BodyKind& kind = kinds_[bodies_[slot].number];
  kind.at = vector_of(dBodyGetPosition(bodies_[slot].id));
  kind.orientation = bodies_[slot].turned();
  kind.account = bodies_[slot].account;
  slot_of_[kind.number] = kNone;
  carried_ &= ~(BodySet{1} << slot);
  dGeomSetBody(kind.geom, nullptr);  // the geom keeps its pose
  dSpaceRemove(space_, kind.geom);
  lie_down(kind);
}

void BodySlots::lie_down(const BodyKind& kind) noexcept {
  const Vector3d origin = kind.lying().position;
  const dQuaternion turned{kind.orientation.w(), kind.orientation.x(), kind.orientation.y(),
                           kind.orientation.z()};
  dGeomSetPosition(kind.geom, origin.x(), origin.y(), origin.z());
  dGeomSetQuaternion(kind.geom, turned);
  asleep_.place(static_cast<std::uint32_t>(kind.number), box_of(kind.geom));
  asleep_energy_ += kind.height_energy(kind.at, gravity_);
  ++lain_down_;
}

BodySet BodySlots::near(BodySet some, double distance) const noexcept {
  // Carried objects join no island: no load changes their motion.
  some &= ~carried();
  std::array<std::array<dReal, 6>, kMost> boxes;
  for (std::size_t i = 0; i < size(); ++i)
    if (!bodies_[i].is_carried) dGeomGetAABB(bodies_[i].geom, boxes[i].data());
  const auto are_near = [&](std::size_t a, std::size_t b) {
    for (std::size_t k = 0; k < 6; k += 2) {
      if (boxes[a][k] > boxes[b][k + 1] + distance || boxes[b][k] > boxes[a][k + 1] + distance)
        return false;
    }
    return true;
  };
  BodySet found = some, fresh = some;
  while (fresh != 0) {
    const auto from = static_cast<std::size_t>(std::countr_zero(fresh));
    fresh &= fresh - 1;
    for (std::size_t i = 0; i < size(); ++i) {
      const BodySet one = BodySet{1} << i;
      if ((found & one) != 0 || bodies_[i].is_carried || !are_near(from, i)) continue;
      found |= one;
      fresh |= one;
    }
  }
  return found;
}

}  // namespace reckon::haptics
