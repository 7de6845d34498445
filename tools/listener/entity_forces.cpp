// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/listener/entity_forces.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "reckon/pdu/seconds.hpp"

namespace reckon::tools {
namespace {

using deadreckon::ForceModel;
using deadreckon::ForcePredictor;
using deadreckon::ProbeState;
using std::chrono::nanoseconds;

bool differ(double a, double b) {
  return std::abs(a - b) > EntityForces::kNewShare * std::max(std::abs(a), std::abs(b));
}

/// Whether coefficients differ; a moved contact point is found by the force.
bool is_new(const ForceModel& a, const ForceModel& b) {
  return a.kind != b.kind || a.surface != b.surface || differ(a.k1, b.k1) || differ(a.k3, b.k3) ||
         differ(a.damping, b.damping) || differ(a.mass, b.mass) || differ(a.radius, b.radius) ||
         differ(a.static_friction, b.static_friction) ||
         differ(a.kinetic_friction, b.kinetic_friction) || differ(a.restitution, b.restitution);
}

}  // namespace

double EntityForces::seconds_of(nanoseconds time) const noexcept {
  return pdu::to_seconds(time - start_.value_or(time));
}

ForcePredictor EntityForces::predictor_of(const Listener& listener,
                                          const ReceivedEntity& entity) const noexcept {
  ForcePredictor predictor;
  if (const ReceivedModel* model = listener.model_of(entity)) {
    predictor.update(model->model, entity.state, seconds_of(model->since));
    predictor.update_entity(entity.state, seconds_of(entity.state_time));
  }
  return predictor;
}

void EntityForces::note_state(const Listener& listener, const StateUpdate& update) {
  const ReceivedEntity& entity = listener.entities()[update.place];
  if (!entity.is_haptic()) return;
  rows_[entity.model].before = predictor_of(listener, entity);
  rows_[entity.model].updated = update.arrival;
}

bool EntityForces::note_model(const Listener& listener, const ModelUpdate& update) {
  const ReceivedEntity& entity = listener.entities()[update.place];
  const nanoseconds now = update.arrival;
  if (!start_.has_value()) start_ = now;
  if (!entity.is_haptic()) rows_.emplace_back();
  Row& row = entity.is_haptic() ? rows_[entity.model] : rows_.back();

  // The Entity State before it has the same arrival, and belongs to the same update.
  const ForcePredictor current = predictor_of(listener, entity);
  if (row.updated != now) row.before = current;
  row.updated = now;
  if (current.weight(seconds_of(now)) <= 0) return true;
  ForcePredictor after;
  after.update(update.model, entity.state, seconds_of(entity.arrival));
  after.update_entity(entity.state, seconds_of(entity.state_time));
  double jump = 0;
  double largest = 0;
  for_probes(listener, entity, now, [&](const ProbeState& probe) {
    const Eigen::Vector3d was = row.before.predict(probe, seconds_of(now));
    const Eigen::Vector3d is = after.predict(probe, seconds_of(now));
    jump = std::max(jump, (is - was).norm());
    largest = std::max({largest, was.norm(), is.norm()});
  });
  if (largest > 0) row.jumps.add(jump);
  return is_new(current.model(), update.model) || jump > kNewForce;
}

void EntityForces::for_probes(const Listener& listener, const ReceivedEntity& entity,
                              nanoseconds now, auto&& look) const {
  for (const ReceivedModel& model :
       listener.models().first(std::min(listener.models().size(), kMostProbes))) {
    const ReceivedEntity& other = listener.entities()[model.owner];
    if (&other != &entity && model.is_probe()) look(model.probe_at(other.pose_at(now)));
  }
}

double EntityForces::contact(const Listener& listener, const ReceivedEntity& entity,
                             nanoseconds now) const {
  double largest = 0;
  if (!entity.is_haptic()) return largest;
  const ForcePredictor predictor = predictor_of(listener, entity);
  for_probes(listener, entity, now, [&](const ProbeState& probe) {
    largest = std::max(largest, predictor.predict(probe, seconds_of(now)).norm());
  });
  return largest;
}

void EntityForces::forget_model(std::size_t model) {
  if (model + 1 != rows_.size()) rows_[model] = std::move(rows_.back());
  rows_.pop_back();
}

}  // namespace reckon::tools
