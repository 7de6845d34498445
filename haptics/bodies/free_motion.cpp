// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/bodies/free_motion.hpp"

#include <algorithm>
#include <cmath>

namespace reckon::haptics {

using Eigen::Vector3d;

FreeMotion::FreeMotion(const BodyGeoms& geoms, BodySlots& slots, const Vector3d& gravity,
                       const WorkSpace& work_space)
    : geoms_(geoms),
      slots_(slots),
      gravity_(gravity),
      work_space_(work_space),
      ray_(dCreateRay(nullptr, 1.0)) {}

Flight FreeMotion::flown(const RigidBody& body, int axis, const Flight& from,
                         double dt) const noexcept {
  const double drag = body.drag / body.mass;
  const Flight end = haptics::fly(from, gravity_[axis], drag, dt);
  if (!work_space_.is_set()) return end;
  const double mean = drag > 0 ? (end.speed - from.speed) / dt : gravity_[axis];
  return bounce(from, mean, walls_of(body, axis), dt);
}

void FreeMotion::fly(std::size_t slot, double dt) noexcept {
  if (!(dt > 0)) return;
  RigidBody& body = slots_[slot];
  Vector3d at = vector_of(dBodyGetPosition(body.id)), v = vector_of(dBodyGetLinearVel(body.id));
  for (int k = 0; k < 3; ++k) {
    const Flight end = flown(body, k, {at[k], v[k]}, dt);
    at[k] = end.place;
    v[k] = end.speed;
  }
  turn(body, dt);
  dBodySetPosition(body.id, at.x(), at.y(), at.z());
  dBodySetLinearVel(body.id, v.x(), v.y(), v.z());
}

void FreeMotion::turn(RigidBody& body, double dt) const noexcept {
  const Vector3d rate = vector_of(dBodyGetAngularVel(body.id));
  const double size = rate.norm();
  if (!(size > 0)) return;
  Eigen::Matrix3d inertia;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) inertia(i, k) = body.inertia.I[4 * i + k];
  const Eigen::Quaterniond from = body.turned();
  const Vector3d momentum = from * (inertia * (from.conjugate() * rate));
  const Eigen::Quaterniond to = Eigen::AngleAxisd(size * dt, rate / size) * from;
  const Vector3d w = to * inertia.ldlt().solve(to.conjugate() * momentum);
  const dQuaternion q{to.w(), to.x(), to.y(), to.z()};
  dBodySetQuaternion(body.id, q);
  dBodySetAngularVel(body.id, w.x(), w.y(), w.z());
}

// Limits of a body's center along an axis of S.
Walls FreeMotion::walls_of(const RigidBody& body, int axis) const noexcept {
  dReal box[6];
  dGeomGetAABB(body.geom, box);
  const double at = dBodyGetPosition(body.id)[axis];
  const double middle = work_space_.position[axis], half = 0.5 * work_space_.size[axis];
  return {middle - half + (at - box[2 * axis]), middle + half - (box[2 * axis + 1] - at),
          work_space_.restitution};
}

// The solver moves a body by its new velocity for the whole step, which conserves the energy of
// springs. A body without contacts flies in closed form instead.
void FreeMotion::fly_exactly(BodySet bodies, double dt) noexcept {
  slots_.each(bodies, [&](std::size_t i) {
    const RigidBody& body = slots_[i];
    if (!(body.mass > 0) || !body.is_awake()) return;
    const bool flies = body.flies && dBodyGetNumJoints(body.id) == 0;
    const double drag = body.drag / body.mass;
    if (!flies && !work_space_.is_set() && !(drag > 0)) return;
    const Vector3d from(body.before.at[0], body.before.at[1], body.before.at[2]);
    const Vector3d speed(body.before.velocity[0], body.before.velocity[1], body.before.velocity[2]);
    Vector3d at = vector_of(dBodyGetPosition(body.id)), v = vector_of(dBodyGetLinearVel(body.id));
    if (!flies) v *= std::exp(-drag * dt);
    for (int k = 0; k < 3; ++k) {
      Flight end{at[k], v[k]};
      if (flies) {
        end = flown(body, k, {from[k], speed[k]}, dt);
      } else if (work_space_.is_set()) {
        end = stop(end, walls_of(body, k));
      }
      at[k] = end.place;
      v[k] = end.speed;
    }
    dBodySetPosition(body.id, at.x(), at.y(), at.z());
    dBodySetLinearVel(body.id, v.x(), v.y(), v.z());
  });
}

// A body that would tunnel is put where its center meets the obstacle, and the next step finds them
// in contact.
void FreeMotion::catch_fast(BodySet bodies) noexcept {
  slots_.each(bodies, [&](std::size_t i) {
    const RigidBody& body = slots_[i];
    if (!(body.mass > 0)) return;
    const Vector3d from(body.before.at[0], body.before.at[1], body.before.at[2]);
    const Vector3d way = vector_of(dBodyGetPosition(body.id)) - from;
    const double length = way.norm();
    if (!(length > 0.5 * body.inner)) return;
    const double free = length_free(body, from, way / length, length);
    if (!(free < length)) return;
    const Vector3d at = from + std::max(0.0, free - 0.9 * body.inner) / length * way;
    dBodySetPosition(body.id, at.x(), at.y(), at.z());
  });
}

// Distance that the center of a body can move before it meets another object.
double FreeMotion::length_free(const RigidBody& body, const Vector3d& from, const Vector3d& way,
                               double length) noexcept {
  dGeomRaySet(ray_, from.x(), from.y(), from.z(), way.x(), way.y(), way.z());
  dGeomRaySetLength(ray_, length);
  double free = length;
  const auto meet = [&](dGeomID geom) {
    dContactGeom hit;
    if (dCollide(ray_, geom, 1, &hit, sizeof hit) > 0) free = std::min(free, hit.depth);
  };
  for (int i = 0; i < dSpaceGetNumGeoms(geoms_.space()); ++i) {
    const dGeomID geom = dSpaceGetGeom(geoms_.space(), i);
    if (dGeomGetBody(geom) != body.id) meet(geom);
  }
  slots_.asleep().visit(box_of(ray_),
                        [&](std::uint32_t number) { meet(slots_.kinds()[number].geom); });
  return free;
}

}  // namespace reckon::haptics
