// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/deadreckon/force/force_predictor.hpp"

#include <algorithm>

#include "reckon/deadreckon/motion/acceleration_trust.hpp"
#include "reckon/deadreckon/motion/convergence.hpp"

namespace reckon::deadreckon {

void ForcePredictor::update(const ForceModel& model, const KinematicState& entity,
                            double now) noexcept {
  model_ = model;
  model_time_ = now;
  has_model_ = true;
  update_entity(entity, now);
}

void ForcePredictor::update_entity(const KinematicState& entity, double now) noexcept {
  entity_ = entity;
  entity_time_ = now;
}

Pose ForcePredictor::entity(double now) const noexcept {
  return extrapolate_trusted(entity_, now - entity_time_);
}

double ForcePredictor::weight(double now) const noexcept {
  if (!has_model_) return 0;
  const double overdue = std::max(0.0, now - model_time_ - model_.validity);
  return convergence_weights(ConvergenceCurve::cubic, overdue, kForceDecay).error;
}

Eigen::Vector3d ForcePredictor::predict(const ProbeState& probe, double now) const noexcept {
  const double share = weight(now);
  if (!(share > 0)) return Eigen::Vector3d::Zero();
  return share * evaluate(model_, entity(now), probe);
}

double ForcePredictor::error(const ForceModel& true_model, const Pose& true_entity,
                             std::span<const ProbeState> probes, double now) const noexcept {
  double worst = 0;
  for (const ProbeState& probe : probes) {
    const Eigen::Vector3d truth = evaluate(true_model, true_entity, probe);
    worst = std::max(worst, (predict(probe, now) - truth).norm());
  }
  return worst;
}

bool ForcePredictor::should_send(const ForceModel& true_model, const Pose& true_entity,
                                 std::span<const ProbeState> probes, double now,
                                 double threshold) const noexcept {
  return error(true_model, true_entity, probes, now) > threshold;
}

}  // namespace reckon::deadreckon
