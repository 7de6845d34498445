// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/bodies/rigid_body.hpp"

#include <algorithm>

#include "reckon/haptics/bodies/body_world.hpp"

namespace reckon::haptics {

using Eigen::Quaterniond;
using Eigen::Vector3d;

Eigen::AlignedBox3d box_of(dGeomID geom) noexcept {
  dReal box[6];
  dGeomGetAABB(geom, box);
  return {Vector3d(box[0], box[2], box[4]), Vector3d(box[1], box[3], box[5])};
}

RigidBody::State RigidBody::state() const noexcept {
  State out;
  std::copy_n(dBodyGetPosition(id), 3, out.at.begin());
  std::copy_n(dBodyGetQuaternion(id), 4, out.turned.begin());
  std::copy_n(dBodyGetLinearVel(id), 3, out.velocity.begin());
  std::copy_n(dBodyGetAngularVel(id), 3, out.turn_rate.begin());
  std::copy_n(dBodyGetForce(id), 3, out.force.begin());
  std::copy_n(dBodyGetTorque(id), 3, out.torque.begin());
  out.awake = is_awake();
  out.still = still;
  out.account = account;
  out.lag = lag;
  return out;
}

void RigidBody::set(const State& state) noexcept {
  const auto& q = state.turned;
  const dQuaternion turned{q[0], q[1], q[2], q[3]};
  dBodySetPosition(id, state.at[0], state.at[1], state.at[2]);
  dBodySetQuaternion(id, turned);
  dBodySetLinearVel(id, state.velocity[0], state.velocity[1], state.velocity[2]);
  dBodySetAngularVel(id, state.turn_rate[0], state.turn_rate[1], state.turn_rate[2]);
  dBodySetForce(id, state.force[0], state.force[1], state.force[2]);
  dBodySetTorque(id, state.torque[0], state.torque[1], state.torque[2]);
  if (state.awake) {
    dBodyEnable(id);
  } else {
    dBodyDisable(id);
  }
  still = state.still;
  account = state.account;
  lag = state.lag;
}

Quaterniond RigidBody::turned() const noexcept {
  const dReal* q = dBodyGetQuaternion(id);
  return {q[0], q[1], q[2], q[3]};
}

ObjectMotion RigidBody::motion() const noexcept {
  const Quaterniond to_S = turned();
  const Vector3d to_middle = to_S * middle;
  const Vector3d rate = vector_of(dBodyGetAngularVel(id));
  return {vector_of(dBodyGetPosition(id)) - to_middle, to_S,
          vector_of(dBodyGetLinearVel(id)) - rate.cross(to_middle), rate};
}

Vector3d RigidBody::velocity_of(const Vector3d& place) const noexcept {
  return vector_of(dBodyGetLinearVel(id)) +
         vector_of(dBodyGetAngularVel(id)).cross(turned() * (place - middle));
}

double RigidBody::kinetic_energy() const noexcept {
  const Vector3d velocity = vector_of(dBodyGetLinearVel(id));
  const Vector3d turning = vector_of(dBodyGetAngularVel(id));
  if (velocity.isZero(0.0) && turning.isZero(0.0)) return 0.0;
  const Vector3d rate = turned().conjugate() * turning;
  double sum = mass * velocity.squaredNorm();
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) sum += rate[i] * inertia.I[4 * i + k] * rate[k];
  return 0.5 * sum;
}

double RigidBody::weight_energy(const Vector3d& gravity) const noexcept {
  return mass > 0 ? height_energy(vector_of(dBodyGetPosition(id)), gravity) : 0.0;
}

double RigidBody::energy(const Vector3d& gravity) const noexcept {
  if (!(mass > 0)) return 0.0;
  return weight_energy(gravity) + kinetic_energy() + std::max(0.0, account);
}

void RigidBody::slow(double factor) noexcept {
  const Vector3d v = factor * vector_of(dBodyGetLinearVel(id));
  const Vector3d w = factor * vector_of(dBodyGetAngularVel(id));
  dBodySetLinearVel(id, v.x(), v.y(), v.z());
  dBodySetAngularVel(id, w.x(), w.y(), w.z());
}

void RigidBody::put(const ObjectMotion& motion) noexcept {
  const Quaterniond& q = motion.orientation;
  const dQuaternion turned{q.w(), q.x(), q.y(), q.z()};
  Vector3d place = motion.position, v = motion.velocity;
  const Vector3d& w = motion.turn_rate;
  if (!middle.isZero(0.0)) {
    place += q * middle;
    v += w.cross(q * middle);
  }
  dBodySetPosition(id, place.x(), place.y(), place.z());
  dBodySetQuaternion(id, turned);
  dBodySetLinearVel(id, v.x(), v.y(), v.z());
  dBodySetAngularVel(id, w.x(), w.y(), w.z());
}

void RigidBody::carry(const ObjectMotion& motion) noexcept {
  put(motion);
  if (motion.velocity.isZero(0.0) && motion.turn_rate.isZero(0.0)) {
    dBodyDisable(id);
  } else {
    dBodyEnable(id);
  }
}

void RigidBody::shift(const Vector3d& way, const Quaterniond& turned) noexcept {
  const Vector3d place = vector_of(dBodyGetPosition(id)) + way +
                         (turned * middle - this->turned() * middle);
  const dQuaternion q{turned.w(), turned.x(), turned.y(), turned.z()};
  dBodySetPosition(id, place.x(), place.y(), place.z());
  dBodySetQuaternion(id, q);
}

void RigidBody::wake() noexcept {
  dBodyEnable(id);
  still = 0.0;
}

void RigidBody::start(const ObjectMotion& motion) noexcept {
  put(motion);
  limit_speed();
  dBodySetForce(id, 0, 0, 0);
  dBodySetTorque(id, 0, 0, 0);
  account = lag = 0.0;
  clear_since = 0;
  wake();
}

void RigidBody::strike(const Vector3d& impulse, const Vector3d& point) noexcept {
  Eigen::Matrix3d own;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) own(i, k) = inertia.I[4 * i + k];
  const Quaterniond q = turned();
  const Vector3d arm = point - vector_of(dBodyGetPosition(id));
  const Vector3d twist = q * own.ldlt().solve(q.conjugate() * arm.cross(impulse));
  const Vector3d v = vector_of(dBodyGetLinearVel(id)) + impulse / mass;
  const Vector3d w = vector_of(dBodyGetAngularVel(id)) + twist;
  dBodySetLinearVel(id, v.x(), v.y(), v.z());
  dBodySetAngularVel(id, w.x(), w.y(), w.z());
  limit_speed();
  wake();
}

// A greater rate of rotation has a greater energy, which a limit of the solver would not see.
void RigidBody::limit_speed() noexcept {
  const double speed = vector_of(dBodyGetLinearVel(id)).norm() / BodyWorld::kFastest;
  const double rate = vector_of(dBodyGetAngularVel(id)).norm() / BodyWorld::kFastestTurn;
  const double most = std::max(speed, rate);
  if (most > 1.0) slow(1.0 / most);
}

void RigidBody::push(const Vector3d& place, const Vector3d& force,
                     const Vector3d& torque) noexcept {
  if (force.squaredNorm() > 0 && !is_awake()) wake();
  const Vector3d point = vector_of(dBodyGetPosition(id)) + turned() * (place - middle);
  dBodyAddForceAtPos(id, force.x(), force.y(), force.z(), point.x(), point.y(), point.z());
  dBodyAddTorque(id, torque.x(), torque.y(), torque.z());
}

}  // namespace reckon::haptics
