// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/listener/entity_forces.hpp"

#include <algorithm>
#include <cmath>

#include "reckon/deadreckon/wire_conversion.hpp"

namespace reckon::tools {
namespace {

using deadreckon::ForceModel;
using deadreckon::ForcePredictor;

/// The ball of a hand is where its device is: the model's point, not the body's origin. Planes and
/// regions are no probes.
std::optional<deadreckon::ProbeState> probe_of(const EntityForce& force, double now) {
  const ForceModel& model = force.predictor.model();
  const bool is_ball = model.kind == pdu::ForceModelKind::sphere;
  if (!is_ball && model.kind != pdu::ForceModelKind::field) return std::nullopt;
  const deadreckon::Pose pose = force.predictor.entity(now);
  return deadreckon::ProbeState{pose.position + pose.orientation * model.point, pose.velocity,
                                is_ball ? model.radius : 0.0};
}

bool differ(double a, double b) {
  return std::abs(a - b) > EntityForces::kNewShare * std::max(std::abs(a), std::abs(b));
}

/// Whether coefficients differ; where the contact point went shows in the force.
bool is_new(const ForceModel& a, const ForceModel& b) {
  return a.kind != b.kind || a.surface != b.surface || differ(a.k1, b.k1) || differ(a.k3, b.k3) ||
         differ(a.damping, b.damping) || differ(a.mass, b.mass) || differ(a.radius, b.radius) ||
         differ(a.static_friction, b.static_friction) ||
         differ(a.kinetic_friction, b.kinetic_friction) || differ(a.restitution, b.restitution);
}

}  // namespace

std::size_t EntityForces::add() {
  forces_.emplace_back();
  return forces_.size() - 1;
}

void EntityForces::update_entity(std::size_t place, const deadreckon::KinematicState& state,
                                 double now) {
  EntityForce& force = forces_[place];
  force.before = force.predictor;
  force.updated = now;
  force.predictor.update_entity(state, now);
}

std::optional<bool> EntityForces::update_model(std::size_t place, const pdu::HapticRecord& record,
                                               const deadreckon::KinematicState& state,
                                               double now) {
  ForceModel model;
  if (from_wire(record, model) != deadreckon::ConversionError::none) return std::nullopt;
  EntityForce& force = forces_[place];
  // The Entity State in front of it is of the same instant, and the same update.
  const ForcePredictor before = force.updated == now ? force.before : force.predictor;
  const bool first = force.predictor.weight(now) <= 0;
  const bool new_coefficients = is_new(force.predictor.model(), model);
  force.predictor.update(model, state, now);
  force.before = before;
  force.updated = now;
  if (first) return true;
  double largest = 0;
  const double jump = change(place, before, now, largest);
  if (largest > 0) force.jumps.add(jump);
  return new_coefficients || jump > kNewForce;
}

double EntityForces::change(std::size_t place, const ForcePredictor& before, double now,
                            double& largest) const {
  double jump = 0;
  for (std::size_t i = 0; i < std::min(forces_.size(), kMostProbes); ++i) {
    const auto probe = i == place ? std::nullopt : probe_of(forces_[i], now);
    if (!probe.has_value()) continue;
    const Eigen::Vector3d was = before.predict(*probe, now);
    const Eigen::Vector3d is = forces_[place].predictor.predict(*probe, now);
    jump = std::max(jump, (is - was).norm());
    largest = std::max({largest, was.norm(), is.norm()});
  }
  return jump;
}

double EntityForces::contact(std::size_t place, double now) const {
  double largest = 0;
  for (std::size_t i = 0; i < std::min(forces_.size(), kMostProbes); ++i) {
    const auto probe = i == place ? std::nullopt : probe_of(forces_[i], now);
    if (!probe.has_value()) continue;
    largest = std::max(largest, forces_[place].predictor.predict(*probe, now).norm());
  }
  return largest;
}

void EntityForces::keep(const std::vector<std::size_t>& places) {
  std::vector<EntityForce> kept;
  kept.reserve(places.size());
  for (const std::size_t place : places) kept.push_back(forces_[place]);
  forces_ = std::move(kept);
}

}  // namespace reckon::tools
