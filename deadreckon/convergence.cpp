// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "deadreckon/convergence.hpp"

#include "deadreckon/rotation.hpp"

namespace reckon::deadreckon {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

ConvergenceWeights linear_weights(double u, double duration) {
  return {1.0 - u, 0.0, -1.0 / duration, 0.0};
}

ConvergenceWeights quadratic_weights(double u, double duration) {
  return {1.0 - u * u, duration * u * (1.0 - u), -2.0 * u / duration, 1.0 - 2.0 * u};
}

ConvergenceWeights projective_weights(double u, double duration) {
  const double left = 1.0 - u;
  return {left, duration * u * left * left, -1.0 / duration, left * (1.0 - 3.0 * u)};
}

ConvergenceWeights cubic_weights(double u, double duration) {
  const double left = 1.0 - u;
  return {left * left * (1.0 + 2.0 * u), duration * u * left * left, -6.0 * u * left / duration,
          left * (1.0 - 3.0 * u)};
}

ConvergenceWeights quintic_weights(double u, double duration) {
  const double left = 1.0 - u;
  const double cube = left * left * left;
  return {cube * (1.0 + u * (3.0 + 6.0 * u)), duration * u * cube * (1.0 + 3.0 * u),
          -30.0 * u * u * left * left / duration, 1.0 + u * u * (-18.0 + u * (32.0 - 15.0 * u))};
}

}  // namespace

ConvergenceWeights convergence_weights(ConvergenceCurve curve, double elapsed,
                                       double duration) noexcept {
  const double u = elapsed / duration;
  if (!(u >= 0 && u < 1)) return {};
  switch (curve) {
    case ConvergenceCurve::linear:
      return linear_weights(u, duration);
    case ConvergenceCurve::quadratic:
      return quadratic_weights(u, duration);
    case ConvergenceCurve::projective:
      return projective_weights(u, duration);
    case ConvergenceCurve::cubic:
      return cubic_weights(u, duration);
    case ConvergenceCurve::quintic:
      return quintic_weights(u, duration);
    case ConvergenceCurve::snap:
      break;
  }
  return {};
}

void PoseConvergence::restart(const Pose& shown, const Pose& predicted, double now) noexcept {
  start_ = now;
  error_ = shown.position - predicted.position;
  error_rate_ = shown.velocity - predicted.velocity;
  turn_ = logarithm(predicted.orientation.conjugate() * shown.orientation);

  // shown = predicted * exp(turn): the shown angular velocity is the predicted one, seen from the
  // shown axes, plus that of the turn itself.
  const Vector3d carried = exponential(turn_).conjugate() * predicted.angular_velocity;
  turn_rate_ = rate_of_rotation_vector(turn_, shown.angular_velocity - carried);
  active_ = settings_.duration > 0 && error_.norm() <= settings_.teleport_distance &&
            error_rate_.allFinite() && turn_.allFinite() && turn_rate_.allFinite();
}

bool PoseConvergence::converging(double now) const noexcept {
  return active_ && settings_.curve != ConvergenceCurve::snap && now >= start_ &&
         now - start_ < settings_.duration;
}

Pose PoseConvergence::shown(const Pose& predicted, double now) const noexcept {
  if (!converging(now)) return predicted;
  const ConvergenceWeights w =
      convergence_weights(settings_.curve, now - start_, settings_.duration);
  const Vector3d turn = w.error * turn_ + w.rate * turn_rate_;
  const Vector3d turn_rate = w.error_rate * turn_ + w.rate_rate * turn_rate_;
  const Quaterniond step = exponential(turn);

  Pose pose;
  pose.position = predicted.position + w.error * error_ + w.rate * error_rate_;
  pose.velocity = predicted.velocity + w.error_rate * error_ + w.rate_rate * error_rate_;
  pose.orientation = predicted.orientation * step;
  pose.angular_velocity =
      step.conjugate() * predicted.angular_velocity + angular_velocity_of(turn, turn_rate);
  return pose;
}

}  // namespace reckon::deadreckon
