// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The predictor of force: a force model on a dead-reckoned entity, with a limited validity.
//
// The owner runs one with the model that it sent, and so computes the force of its peers. It sends
// again if this force differs from the force of its true model by more than a threshold in newtons.
#pragma once

#include <Eigen/Core>
#include <span>

#include "reckon/deadreckon/force/force_model.hpp"
#include "reckon/deadreckon/motion/kinematic_state.hpp"

namespace reckon::deadreckon {

/// Time [s] in which the force falls to zero after the validity.
inline constexpr double kForceDecay = 0.1;

/// A force model as last sent or received, on its entity. Times are seconds of one steady clock,
/// which the caller chooses. Not synchronised: one thread, or copies. No allocation.
class ForcePredictor {
 public:
  /// Takes a new model and its entity state, both of the time `now` [s].
  void update(const ForceModel& model, const KinematicState& entity, double now) noexcept;

  /// Takes a new entity state; the age of the model continues.
  void update_entity(const KinematicState& entity, double now) noexcept;

  /// Discards the model: no force from now on.
  void clear() noexcept { has_model_ = false; }

  /// Force on the probe at `now` [N], reference axes; zero without a model or after its end.
  [[nodiscard]] Eigen::Vector3d predict(const ProbeState& probe, double now) const noexcept;

  /// Pose of the entity at `now`.
  [[nodiscard]] Pose entity(double now) const noexcept;

  /// Share of the force at `now`: 1 while valid, then down to 0 within kForceDecay by a cubic, so
  /// that the force has no step in its rate. 0 without a model.
  [[nodiscard]] double weight(double now) const noexcept;

  /// Whether the model no longer has a force.
  [[nodiscard]] bool expired(double now) const noexcept { return weight(now) <= 0; }

  /// Largest difference [N] over the probes between the predicted force and the owner's true one.
  [[nodiscard]] double error(const ForceModel& true_model, const Pose& true_entity,
                             std::span<const ProbeState> probes, double now) const noexcept;

  /// Whether the error of the peers' force exceeds `threshold` [N] at any of the probes. A model
  /// that was never sent, or has expired, counts as no force.
  [[nodiscard]] bool should_send(const ForceModel& true_model, const Pose& true_entity,
                                 std::span<const ProbeState> probes, double now,
                                 double threshold) const noexcept;

  /// The last model.
  [[nodiscard]] const ForceModel& model() const noexcept { return model_; }

 private:
  ForceModel model_;
  KinematicState entity_;
  double model_time_ = 0;
  double entity_time_ = 0;
  bool has_model_ = false;
};

}  // namespace reckon::deadreckon
