// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/deadreckon/extrapolators/position_history.hpp"

#include <algorithm>

#include "reckon/deadreckon/motion/drm.hpp"

namespace reckon::deadreckon {

Pose position_history(const MotionHistory& history, double tau, const StepLimits& limits,
                      const AccelerationCutoffs& cutoffs) noexcept {
  Pose pose = first_order_two_step(history, tau, limits);
  const double gap = usable_gap(history, limits);
  if (gap == 0 || history.size() < 3) return pose;
  const double gap_before = history[1].time - history[2].time;
  if (gap_before < limits.shortest_gap) return pose;

  const Eigen::Vector3d velocity = (history[0].position - history[1].position) / gap;
  const Eigen::Vector3d velocity_before = (history[1].position - history[2].position) / gap_before;
  const Eigen::Vector3d acceleration = (velocity - velocity_before) / (0.5 * (gap + gap_before));
  const double size = acceleration.norm();
  if (!(size >= cutoffs.minimal && size <= cutoffs.substantial)) return pose;

  // The mean velocity over the gap is the velocity at its middle, and changes in the half gap until
  // its end. The position has the same half gap, so that the parabola passes through x'' too.
  const double bounded = bounded_tau(tau);
  const double t = std::min(bounded, limits.most_gaps * gap);
  pose.position += (0.5 * t * (gap + t)) * acceleration;
  if (t == bounded) pose.velocity += (0.5 * gap + t) * acceleration;
  return pose;
}

Pose position_history(const MotionHistory& history, double tau, const StepLimits& limits) noexcept {
  return position_history(history, tau, limits, AccelerationCutoffs{});
}

}  // namespace reckon::deadreckon
