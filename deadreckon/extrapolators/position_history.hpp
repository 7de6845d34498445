// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Position-history-based dead reckoning (PHBDR): only positions are sent, and the receiver derives
// velocity and acceleration from the last three. Thesis 4.4, after Singhal and Cheriton.
#pragma once

#include <algorithm>

#include "reckon/deadreckon/extrapolators/multi_step.hpp"
#include "reckon/deadreckon/motion/drm.hpp"

namespace reckon::deadreckon {

/// Range of accelerations for the second order.
struct AccelerationCutoffs {
  /// A lower acceleration [m/s^2] is noise: first order. Default 0.1, >= 0.
  double minimal = 0.1;
  /// A higher acceleration [m/s^2] is an abrupt motion that does not continue, such as a turn on
  /// the spot or a jump: first order. Default 20, > minimal.
  double substantial = 20.0;
};

/// x' + v tau + a tau^2 / 2, with v and a of the parabola through the last three positions. The
/// first order through the last two is used where |a| is minimal or substantial. (The thesis
/// describes only the first order; the second order between the cut-offs is from Singhal and
/// Cheriton.) With fewer samples, short gaps or long silences it behaves as first_order_two_step,
/// which holds the position if there is no usable gap and no sent velocity. Any thread, no
/// allocation.
[[nodiscard]] inline Pose position_history(const MotionHistory& history, double tau,
                                           const StepLimits& limits,
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

/// The same with the default cut-offs.
[[nodiscard]] inline Pose position_history(const MotionHistory& history, double tau,
                                           const StepLimits& limits) noexcept {
  return position_history(history, tau, limits, AccelerationCutoffs{});
}

}  // namespace reckon::deadreckon
