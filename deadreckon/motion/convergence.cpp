// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/deadreckon/motion/convergence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reckon/deadreckon/motion/rotation.hpp"

namespace reckon::deadreckon {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

// Limit of the duration of an error, in intervals between updates.
constexpr double kIntervals = 1.5;

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
  return {
      cube * (1.0 + u * (3.0 + 6.0 * u)),       duration * u * cube * (1.0 + 3.0 * u),
      -30.0 * u * u * left * left / duration,   1.0 + u * u * (-18.0 + u * (32.0 - 15.0 * u)),
      0.5 * duration * duration * u * u * cube, 0.5 * duration * u * left * left * (2.0 - 5.0 * u)};
}

// Second derivative of the quintic's error, for this e0, f0 and g0.
Vector3d quintic_acceleration(double u, double duration, const Vector3d& error,
                              const Vector3d& rate, const Vector3d& acceleration) {
  const double left = 1.0 - u;
  return left * ((-60.0 * u * (1.0 - 2.0 * u) / (duration * duration)) * error +
                 (-12.0 * u * (3.0 - 5.0 * u) / duration) * rate +
                 (1.0 + u * (-8.0 + 10.0 * u)) * acceleration);
}

// Limits of the duration: an error decays before it could grow by this many H at its present rate,
// and by its acceleration. With these limits the curves keep their near_bound.
constexpr double kRegrowth = 2.0, kCarried = 3.0;
// If an update moves the prediction by more thresholds than this, the owner exceeds its thresholds,
// or another update was lost. The shown pose then follows without a step.
constexpr double kKept = 2.0;

// An error at an update, and its motion: position or rotation.
struct ErrorAtUpdate {
  Vector3d& error;
  const Vector3d &rate, &acceleration;
  double left;        // remainder of the previous error
  double innovation;  // change of the prediction by the update
};

// Keeps an error near the prediction; returns the longest Tc for that. `most`: see ConvergingError.
double keep_near(const ErrorAtUpdate& at, double threshold, double& most) {
  const double bound = std::max({threshold, at.innovation, std::min(most, at.left)});
  const double size = at.error.norm();
  if (at.innovation <= kKept * threshold && size > bound) at.error *= bound / size;
  most = std::max(bound, at.error.norm());
  return std::min(kRegrowth * most / at.rate.norm(),
                  std::sqrt(kCarried * most / at.acceleration.norm()));
}

// Tc for an error and a rotation of this size [m], [rad], with this interval since the last one
// [s].
double gentle_duration(const ConvergenceSettings& settings, double error, double turn, double speed,
                       double interval) {
  const double least = std::clamp(
      kIntervals * interval, std::min(settings.shortest, settings.duration), settings.duration);
  const double most = std::max(least, std::min(kIntervals * interval, settings.longest));
  const double gentle = std::max(settings.gentle_speed, settings.gentle_share * speed);
  return std::clamp(1.5 * std::max(error / gentle, turn / settings.gentle_turn), least, most);
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

// Takes over the acceleration of the present error at `now`, if there is one.
void ConvergingError::carry_acceleration(double now) noexcept {
  if (curve_ != ConvergenceCurve::quintic || !converging(now)) {
    acceleration_.setZero();
    turn_acceleration_.setZero();
    return;
  }
  const double u = (now - start_) / duration_;
  acceleration_ = quintic_acceleration(u, duration_, error_, error_rate_, acceleration_);
  turn_acceleration_ = quintic_acceleration(u, duration_, turn_, turn_rate_, turn_acceleration_);
}

void ConvergingError::restart(const ConvergenceSettings& settings, const Pose& shown,
                              const Pose& predicted, double now) noexcept {
  const bool is_kept_near = std::isfinite(settings.threshold);
  const Left left = is_kept_near ? left_at(now) : Left();
  carry_acceleration(now);
  curve_ = settings.curve;
  const double interval =
      started_ ? std::max(now - start_, 0.0) : std::numeric_limits<double>::infinity();
  start_ = now;
  started_ = true;
  error_ = shown.position - predicted.position;
  error_rate_ = shown.velocity - predicted.velocity;
  turn_ = logarithm(predicted.orientation.conjugate() * shown.orientation);

  // shown = predicted * exp(turn): the shown angular velocity is the predicted one in the shown
  // axes, plus the angular velocity of `turn`.
  const Quaterniond turn = exponential(turn_);
  const Vector3d carried = turn.conjugate() * predicted.angular_velocity;
  turn_rate_ = rate_of_rotation_vector(turn_, shown.angular_velocity - carried);
  duration_ =
      gentle_duration(settings, error_.norm(), turn_.norm(), predicted.velocity.norm(), interval);
  if (is_kept_near) keep_near(settings, turn, left);
  // An angle of pi may be an ulp larger after rounding.
  active_ = settings.duration > 0 && error_.norm() <= settings.teleport_distance &&
            turn_.norm() <= settings.teleport_angle + 1e-9 && error_rate_.allFinite() &&
            turn_rate_.allFinite() && std::isfinite(duration_);
}

void ConvergingError::keep_near(const ConvergenceSettings& settings, const Quaterniond& turn,
                                const Left& left) noexcept {
  // The rotation of this update alone is the present one without the remainder of the previous one.
  const double turned = logarithm(turn * exponential(left.turn).conjugate()).norm();
  duration_ = std::min(
      {duration_,
       deadreckon::keep_near(
           {error_, error_rate_, acceleration_, left.error.norm(), (error_ - left.error).norm()},
           settings.threshold, most_),
       deadreckon::keep_near({turn_, turn_rate_, turn_acceleration_, left.turn.norm(), turned},
                             settings.threshold_angle, most_turn_)});
}

ConvergingError::Left ConvergingError::left_at(double now) const noexcept {
  if (!converging(now)) return {};
  const ConvergenceWeights w = convergence_weights(curve_, now - start_, duration_);
  return {w.error * error_ + w.rate * error_rate_ + w.acceleration * acceleration_,
          w.error * turn_ + w.rate * turn_rate_ + w.acceleration * turn_acceleration_};
}

bool ConvergingError::converging(double now) const noexcept {
  return active_ && curve_ != ConvergenceCurve::snap && now >= start_ && now - start_ < duration_;
}

Pose ConvergingError::shown(const Pose& predicted, double now) const noexcept {
  if (!converging(now)) return predicted;
  const ConvergenceWeights w = convergence_weights(curve_, now - start_, duration_);
  const Vector3d turn = w.error * turn_ + w.rate * turn_rate_ + w.acceleration * turn_acceleration_;
  const Vector3d turn_rate =
      w.error_rate * turn_ + w.rate_rate * turn_rate_ + w.acceleration_rate * turn_acceleration_;
  const Quaterniond step = exponential(turn);

  Pose pose;
  pose.position =
      predicted.position + w.error * error_ + w.rate * error_rate_ + w.acceleration * acceleration_;
  pose.velocity = predicted.velocity + w.error_rate * error_ + w.rate_rate * error_rate_ +
                  w.acceleration_rate * acceleration_;
  pose.orientation = predicted.orientation * step;
  pose.angular_velocity =
      step.conjugate() * predicted.angular_velocity + angular_velocity_of(turn, turn_rate);
  return pose;
}

}  // namespace reckon::deadreckon
