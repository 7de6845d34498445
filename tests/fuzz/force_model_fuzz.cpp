// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// An Entity State and the records of an Attribute PDU as they reach the servo. A model from the
// wire is finite, passes the same checks when sent back, and gives a finite force that never pulls,
// at any probe position. No heap.
#include <array>
#include <cmath>

#include "reckon/deadreckon/force/force_model.hpp"
#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/deadreckon/wire_conversion.hpp"
#include "reckon/pdu/bundle.hpp"
#include "reckon/pdu/entity/attribute.hpp"
#include "reckon/tests/fuzz/fuzz_target.hpp"
#include "reckon/tests/fuzz/wire_mutator.hpp"

namespace reckon::fuzz {
namespace {

using deadreckon::ConversionError;
using deadreckon::ForceModel;
using deadreckon::KinematicState;
using Eigen::Vector3d;

const deadreckon::LocalFrame kFrame(0.6, -2.1, 30.0);

void check_state(const pdu::EntityState& pdu, KinematicState& state) {
  if (from_wire(pdu, kFrame, state) != ConversionError::none) return;
  require(is_finite(state), "a motion that is not finite was taken");
  for (const double tau : {0.0, 0.001, 1.0, 12.0, 1e9})
    require(is_finite(extrapolate(state, tau)), "a prediction is not finite");
}

bool is_finite(const ForceModel& m) {
  const Eigen::Array<double, 8, 1> numbers{
      m.k1,          m.k3,    m.damping, m.mass, m.static_friction, m.kinetic_friction,
      m.restitution, m.radius};
  return numbers.allFinite() && (numbers >= 0).all() && m.point.allFinite() &&
         m.normal.allFinite() && std::isfinite(m.validity);
}

void check_force(const ForceModel& model, const deadreckon::Pose& entity) {
  const Vector3d point = entity.position + entity.orientation * model.point;
  const Vector3d normal = entity.orientation * model.normal;
  for (const double depth : {-1e-3, 0.0, 1e-9, 1e-3, 0.1, 1e3}) {
    const Vector3d probe = point + (model.radius - depth) * normal;
    for (const double speed : {-1e3, 0.0, 1.0}) {
      const Vector3d force = evaluate(model, entity, probe, speed * normal, 0.01);
      require(force.allFinite(), "a force is not finite");
      const Vector3d outwards = contact(model, entity, probe, 0.01).normal;
      require(force.isZero(0) || force.dot(outwards) >= 0, "a force pulls");
    }
  }
}

void check_model(const pdu::HapticRecord& record, const KinematicState& state) {
  ForceModel model;
  if (from_wire(record, model) != ConversionError::none) return;
  require(is_finite(model), "a force model that is not finite was taken");
  require(std::abs(model.normal.norm() - 1) < 1e-12, "a normal is not of length 1");
  pdu::HapticRecord back;
  require(to_wire(model, back) == ConversionError::none, "a model taken cannot be sent");
  ForceModel again;
  require(from_wire(back, again) == ConversionError::none, "a model sent on is refused");
  check_force(model, deadreckon::Pose{});
  check_force(model, extrapolate(state, 0.01));
}

void check_records(const pdu::Attribute& attribute, const KinematicState& state) {
  for (const pdu::AttributeSet& set : pdu::AttributeReader(attribute)) {
    for (const pdu::AttributeRecord& record : set.records()) {
      pdu::HapticRecord haptic;
      if (decode(record, haptic) == pdu::DecodeError::none) check_model(haptic, state);
    }
  }
}

}  // namespace

void check(std::span<const std::byte> datagram) {
  const HeapMeter heap;
  KinematicState state;
  for (const pdu::BundledPdu& bundled : pdu::BundleReader(datagram)) {
    pdu::EntityState entity;
    pdu::Attribute attribute;
    if (decode(bundled.bytes, entity) == pdu::DecodeError::none) check_state(entity, state);
    if (decode(bundled.bytes, attribute) == pdu::DecodeError::none) check_records(attribute, state);
  }
  require(heap.allocations() == 0, "the way from the wire to the force took heap");
}

}  // namespace reckon::fuzz

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t max_size, unsigned seed) {
  size = LLVMFuzzerMutate(data, size, max_size);
  if (seed % 8 != 0)
    reckon::fuzz::repair_last_length(std::as_writable_bytes(std::span(data, size)));
  return size;
}
