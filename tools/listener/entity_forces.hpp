// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The forces of a listener's models at the probes of other entities, fading after their validity as
// in a peer's predictor, and their changes by new models.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "reckon/deadreckon/force/force_predictor.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/tools/listener/jump_histogram.hpp"
#include "reckon/tools/listener/listener.hpp"

namespace reckon::tools {

/// Force changes by the models of a listener; rows have the indices of the models. One thread.
class EntityForces {
 public:
  /// Limit of other entities at whose probes a force is evaluated.
  static constexpr std::size_t kMostProbes = 64;
  /// A model is new if a coefficient differs by this share, or the force by this [N].
  static constexpr double kNewShare = 1e-3;
  static constexpr double kNewForce = 0.01;

  /// Called before a state is taken: keeps the present prediction of its model.
  void note_state(const Listener& listener, const StateUpdate& update) {
    const ReceivedEntity& entity = listener.entities()[update.place];
    if (!entity.is_haptic()) return;
    rows_[entity.model].before = predictor_of(listener, entity);
    rows_[entity.model].updated = update.arrival;
  }
  /// Called before a model is taken. @return whether it is new, see kNewShare
  [[nodiscard]] bool note_model(const Listener& listener, const ModelUpdate& update) {
    const ReceivedEntity& entity = listener.entities()[update.place];
    const std::chrono::nanoseconds now = update.arrival;
    if (!start_.has_value()) start_ = now;
    if (!entity.is_haptic()) rows_.emplace_back();
    Row& row = entity.is_haptic() ? rows_[entity.model] : rows_.back();

    // The Entity State before it has the same arrival, and belongs to the same update.
    const deadreckon::ForcePredictor current = predictor_of(listener, entity);
    if (row.updated != now) row.before = current;
    row.updated = now;
    if (current.weight(seconds_of(now)) <= 0) return true;
    deadreckon::ForcePredictor after;
    after.update(update.model, entity.state, seconds_of(entity.arrival));
    after.update_entity(entity.state, seconds_of(entity.state_time));
    double jump = 0;
    double largest = 0;
    for_probes(listener, entity, now, [&](const deadreckon::ProbeState& probe) {
      const Eigen::Vector3d was = row.before.predict(probe, seconds_of(now));
      const Eigen::Vector3d is = after.predict(probe, seconds_of(now));
      jump = std::max(jump, (is - was).norm());
      largest = std::max({largest, was.norm(), is.norm()});
    });
    if (largest > 0) row.jumps.add(jump);
    return is_new(current.model(), update.model) || jump > kNewForce;
  }
  /// Called before the listener drops the entity of this model.
  void forget_model(std::size_t model) {
    if (model + 1 != rows_.size()) rows_[model] = std::move(rows_.back());
    rows_.pop_back();
  }

  /// Force changes of this model at updates, in contact only [N].
  [[nodiscard]] const JumpHistogram& jumps(std::size_t model) const { return rows_[model].jumps; }
  /// The largest force [N] of the entity's model at the probe of another entity; 0 without one.
  [[nodiscard]] double contact(const Listener& listener, const ReceivedEntity& entity,
                               std::chrono::nanoseconds now) const {
    double largest = 0;
    if (!entity.is_haptic()) return largest;
    const deadreckon::ForcePredictor predictor = predictor_of(listener, entity);
    for_probes(listener, entity, now, [&](const deadreckon::ProbeState& probe) {
      largest = std::max(largest, predictor.predict(probe, seconds_of(now)).norm());
    });
    return largest;
  }

 private:
  static bool differ(double a, double b) {
    return std::abs(a - b) > EntityForces::kNewShare * std::max(std::abs(a), std::abs(b));
  }
  /// Whether coefficients differ; a moved contact point is found by the force.
  static bool is_new(const deadreckon::ForceModel& a, const deadreckon::ForceModel& b) {
    return a.kind != b.kind || a.surface != b.surface || differ(a.k1, b.k1) || differ(a.k3, b.k3) ||
           differ(a.damping, b.damping) || differ(a.mass, b.mass) || differ(a.radius, b.radius) ||
           differ(a.static_friction, b.static_friction) ||
           differ(a.kinetic_friction, b.kinetic_friction) || differ(a.restitution, b.restitution);
  }

  struct Row {
    deadreckon::ForcePredictor before;   // prediction before the last update
    std::chrono::nanoseconds updated{};  // time of the last update
    JumpHistogram jumps;
  };
  [[nodiscard]] double seconds_of(std::chrono::nanoseconds time) const noexcept {
    return pdu::to_seconds(time - start_.value_or(time));
  }
  [[nodiscard]] deadreckon::ForcePredictor predictor_of(
      const Listener& listener, const ReceivedEntity& entity) const noexcept {
    deadreckon::ForcePredictor predictor;
    if (const ReceivedModel* model = listener.model_of(entity)) {
      predictor.update(model->model, entity.state, seconds_of(model->since));
      predictor.update_entity(entity.state, seconds_of(entity.state_time));
    }
    return predictor;
  }
  /// Calls `look(probe)` for the probes of other entities.
  void for_probes(const Listener& listener, const ReceivedEntity& entity,
                  std::chrono::nanoseconds now, auto&& look) const {
    for (const ReceivedModel& model :
         listener.models().first(std::min(listener.models().size(), kMostProbes))) {
      const ReceivedEntity& other = listener.entities()[model.owner];
      if (&other != &entity && model.is_probe()) look(model.probe_at(other.pose_at(now)));
    }
  }

  std::vector<Row> rows_;
  std::optional<std::chrono::nanoseconds> start_;  // zero of the predictors' time
};

}  // namespace reckon::tools
