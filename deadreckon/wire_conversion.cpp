// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/deadreckon/wire_conversion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace reckon::deadreckon {

namespace {

using Eigen::Vector3d;
using Error = ConversionError;
using Kind = pdu::ForceModelKind;

constexpr double kNormalTolerance = 1e-3;
constexpr double kLongestValidity_ms = 65535;

constexpr std::array<std::string_view, 13> kSentences = {
    "no error",
    "a number is NaN or infinite",
    "the location is farther than 1e9 m from the earth's centre",
    "a velocity, acceleration or angular velocity is past its limit",
    "the force model is of a kind or order that is not evaluated here",
    "k1 or k3 is negative",
    "the damping is negative",
    "the mass is negative",
    "k1, k3, the damping or the mass is past its limit",
    "a friction coefficient is negative, past 10, or kinetic above static",
    "the restitution is outside 0 to 1",
    "the normal is not of length 1",
    "the radius or the distance of the point is negative or past 1e4 m",
};

Vector3d vector(const pdu::Vector3Float& v) { return {v.x, v.y, v.z}; }

pdu::Vector3Float wire_vector(const Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

Error check(const KinematicState& world) {
  if (!is_finite(world)) return Error::not_finite;
  if (world.position.norm() > kLargestLocation) return Error::location_range;
  const bool slow = world.velocity.norm() <= kLargestSpeed &&
                    world.acceleration.norm() <= kLargestAcceleration &&
                    world.angular_velocity.norm() <= kLargestAngularVelocity;
  return slow ? Error::none : Error::speed_range;
}

bool all_finite(const ForceModel& m) {
  const Eigen::Array<double, 8, 1> numbers{
      m.k1,          m.k3,    m.damping, m.mass, m.static_friction, m.kinetic_friction,
      m.restitution, m.radius};
  return numbers.allFinite() && m.point.allFinite() && m.normal.allFinite() &&
         std::isfinite(m.validity);
}

Error check_spring(const ForceModel& m) {
  if (m.k1 < 0 || m.k3 < 0) return Error::negative_stiffness;
  if (m.damping < 0) return Error::negative_damping;
  if (m.mass < 0) return Error::negative_mass;
  const bool sane = m.k1 <= kLargestStiffness && m.k3 <= kLargestHardening &&
                    m.damping <= kLargestDamping && m.mass <= kLargestMass;
  return sane ? Error::none : Error::stiffness_range;
}

Error check_surface(const ForceModel& m) {
  const bool ordered = 0 <= m.kinetic_friction && m.kinetic_friction <= m.static_friction &&
                       m.static_friction <= kLargestFriction;
  if (!ordered) return Error::friction_range;
  return m.restitution >= 0 && m.restitution <= 1 ? Error::none : Error::restitution_range;
}

// Round shapes need no normal: zero means "not stated".
bool may_lack_normal(Kind kind) {
  return kind == Kind::none || kind == Kind::sphere || kind == Kind::field;
}

Error check_shape(const ForceModel& m) {
  if (m.radius < 0 || m.radius > kLargestSize || m.point.norm() > kLargestSize) {
    return Error::size_range;
  }
  if (may_lack_normal(m.kind) && m.normal.isZero(0)) return Error::none;
  return std::abs(m.normal.norm() - 1.0) <= kNormalTolerance ? Error::none : Error::normal_not_unit;
}

Error check(const ForceModel& m) {
  if (m.kind > Kind::spring_damper_region) return Error::kind_unknown;
  if (!all_finite(m)) return Error::not_finite;
  if (const Error e = check_spring(m); e != Error::none) return e;
  if (const Error e = check_surface(m); e != Error::none) return e;
  return check_shape(m);
}

pdu::DeadReckoningAlgorithm algorithm_of(const pdu::EntityState& pdu) {
  const bool still = (pdu.appearance & (pdu::kAppearanceFrozen | pdu::kAppearanceDeactivated)) != 0;
  return still ? pdu::DeadReckoningAlgorithm::static_ : pdu.dead_reckoning.algorithm;
}

// Difference between the two readings of a state's acceleration: w x V for RVB. RPB sends no
// acceleration, and the F models have no w.
Vector3d turning_share(const KinematicState& state, AccelerationReading reading) {
  const bool differs = reading == AccelerationReading::inertial &&
                       state.algorithm == pdu::DeadReckoningAlgorithm::rvb;
  return differs ? state.angular_velocity.cross(state.velocity) : Vector3d(0, 0, 0);
}

Eigen::Quaterniond orientation_of(const pdu::EulerAngles& wire) {
  return quaternion_from_euler({wire.psi, wire.theta, wire.phi});
}

bool is_finite(const pdu::EulerAngles& wire) {
  return std::isfinite(wire.psi) && std::isfinite(wire.theta) && std::isfinite(wire.phi);
}

// The received state in W without its orientation, with our reading of the acceleration.
KinematicState world_state(const pdu::EntityState& pdu, AccelerationReading reading) {
  KinematicState world;
  world.algorithm = algorithm_of(pdu);
  world.position = {pdu.location.x, pdu.location.y, pdu.location.z};
  world.velocity = vector(pdu.linear_velocity);
  world.acceleration = vector(pdu.dead_reckoning.linear_acceleration);
  world.angular_velocity = vector(pdu.dead_reckoning.angular_velocity);
  world.acceleration -= turning_share(world, reading);
  return world;
}

}  // namespace

std::string_view sentence(ConversionError error) noexcept {
  const auto row = static_cast<std::size_t>(error);
  return row < kSentences.size() ? kSentences[row] : "unknown error";
}

ConversionError motion_from_wire(const pdu::EntityState& pdu, const LocalFrame& frame,
                                 KinematicState& out, AccelerationReading reading) noexcept {
  KinematicState state = world_state(pdu, reading);
  if (!is_finite(pdu.orientation)) return Error::not_finite;
  if (const Error e = check(state); e != Error::none) return e;
  state.position = frame.scene_from_world(state.position);
  if (!drm_terms(state.algorithm).body_axes) {
    state.velocity = frame.scene_from_world_vector(state.velocity);
    state.acceleration = frame.scene_from_world_vector(state.acceleration);
  }
  out = state;
  return Error::none;
}

Eigen::Quaterniond orientation_from_wire(const pdu::EulerAngles& wire,
                                         const LocalFrame& frame) noexcept {
  return frame.scene_from_world(orientation_of(wire)).normalized();
}

ConversionError from_wire(const pdu::EntityState& pdu, const LocalFrame& frame, KinematicState& out,
                          AccelerationReading reading) noexcept {
  const Error e = motion_from_wire(pdu, frame, out, reading);
  if (e == Error::none) out.orientation = orientation_from_wire(pdu.orientation, frame);
  return e;
}

ConversionError from_wire(const pdu::EntityState& pdu, KinematicState& out,
                          AccelerationReading reading) noexcept {
  KinematicState state = world_state(pdu, reading);
  state.orientation = orientation_of(pdu.orientation);
  if (const Error e = check(state); e != Error::none) return e;
  out = state;
  return Error::none;
}

ConversionError to_wire(const KinematicState& state, const LocalFrame& frame, pdu::EntityState& pdu,
                        AccelerationReading reading) noexcept {
  KinematicState world = state;
  const DrmTerms terms = drm_terms(state.algorithm);
  world.position = frame.world_from_scene(state.position);
  world.orientation = frame.world_from_scene(state.orientation);
  if (!terms.body_axes) {
    world.velocity = frame.world_from_scene_vector(state.velocity);
    world.acceleration = frame.world_from_scene_vector(state.acceleration);
  }
  if (!terms.rotation) world.angular_velocity.setZero();
  world.acceleration += turning_share(world, reading);
  if (const Error e = check(world); e != Error::none) return e;

  const Euler euler = euler_from_quaternion(world.orientation);
  pdu.location = {world.position.x(), world.position.y(), world.position.z()};
  pdu.orientation = {static_cast<float>(euler.psi), static_cast<float>(euler.theta),
                     static_cast<float>(euler.phi)};
  pdu.linear_velocity = wire_vector(world.velocity);
  pdu.dead_reckoning.algorithm = state.algorithm;
  pdu.dead_reckoning.linear_acceleration = wire_vector(world.acceleration);
  pdu.dead_reckoning.angular_velocity = wire_vector(world.angular_velocity);
  return Error::none;
}

ConversionError from_wire(const pdu::HapticRecord& record, ForceModel& out) noexcept {
  ForceModel model;
  model.kind = record.kind;
  model.k1 = record.k1;
  model.k3 = record.k3;
  model.damping = record.damping;
  model.mass = record.mass;
  model.static_friction = record.static_friction;
  model.kinetic_friction = record.kinetic_friction;
  model.restitution = record.restitution;
  model.radius = record.radius;
  model.point = vector(record.point);
  model.normal = vector(record.normal);
  model.surface = record.surface;
  model.grip = record.grip_stiffness;
  model.validity = 1e-3 * record.validity_ms;

  if (record.order != 0) return Error::kind_unknown;
  if (const Error e = check(model); e != Error::none) return e;
  model.normal = model.normal.isZero(0) ? ForceModel{}.normal : model.normal.normalized();
  out = model;
  return Error::none;
}

ConversionError to_wire(const ForceModel& model, pdu::HapticRecord& record) noexcept {
  if (const Error e = check(model); e != Error::none) return e;
  record.kind = model.kind;
  record.order = 0;
  record.k1 = static_cast<float>(model.k1);
  record.k3 = static_cast<float>(model.k3);
  record.damping = static_cast<float>(model.damping);
  record.mass = static_cast<float>(model.mass);
  record.static_friction = static_cast<float>(model.static_friction);
  record.kinetic_friction = static_cast<float>(model.kinetic_friction);
  record.restitution = static_cast<float>(model.restitution);
  record.radius = static_cast<float>(model.radius);
  record.point = wire_vector(model.point);
  record.normal = wire_vector(model.normal);
  record.surface = model.surface;
  record.grip_stiffness = model.grip;
  const double milliseconds = std::ceil(1e3 * model.validity - 1e-6);
  record.validity_ms =
      static_cast<std::uint16_t>(std::clamp(milliseconds, 0.0, kLongestValidity_ms));
  return Error::none;
}

}  // namespace reckon::deadreckon
