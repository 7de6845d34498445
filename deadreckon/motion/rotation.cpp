// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/deadreckon/motion/rotation.hpp"

#include <cmath>

namespace reckon::deadreckon {

namespace {

// Below this angle the differences in the Jacobians cancel. The first terms of their series, with x
// = angle^2, are then exact to rounding.
constexpr double kSmallAngle = 0.05;

// Below this half angle, or its tangent, series in its square are exact to rounding too. Most
// updates move by less, and sines and arc tangents would cost more than all the rest.
constexpr double kSmallHalf = 0.03;

// sin h / h and cos h.
struct HalfTurn {
  double sine_over_half, cosine;
};

HalfTurn half_turn(double x) {
  if (x < kSmallHalf * kSmallHalf) {
    return {1.0 - x * (1.0 / 6 - x * (1.0 / 120 - x * (1.0 / 5040))),
            1.0 - x * (0.5 - x * (1.0 / 24 - x * (1.0 / 720)))};
  }
  const double half = std::sqrt(x);
  return {std::sin(half) / half, std::cos(half)};
}

// Half angle over its sine s, for a quaternion with sine s and cosine c >= 0 of it; 1 at zero.
double half_over_sine(double s, double c) {
  if (s < kSmallHalf * c) {
    const double x = (s / c) * (s / c);
    return (1.0 - x * (1.0 / 3 - x * (0.2 - x * (1.0 / 7 - x * (1.0 / 9 - x * (1.0 / 11)))))) / c;
  }
  return std::atan2(s, c) / s;
}

// (1 - cos a) / a^2 and (a - sin a) / a^3.
struct JacobianTerms {
  double cross;
  double twice;
};

JacobianTerms jacobian_terms(double angle) {
  const double x = angle * angle;
  if (angle < kSmallAngle) {
    return {0.5 - x * (1.0 / 24 - x * (1.0 / 720 - x * (1.0 / 40320))),
            1.0 / 6 - x * (1.0 / 120 - x * (1.0 / 5040 - x * (1.0 / 362880)))};
  }
  const double s = std::sin(0.5 * angle);
  return {2.0 * s * s / x, (angle - std::sin(angle)) / (x * angle)};
}

// 1/a^2 - cot(a/2) / (2 a).
double inverse_jacobian_term(double angle) {
  const double x = angle * angle;
  if (angle < kSmallAngle) {
    return 1.0 / 12 + x * (1.0 / 720 + x * (1.0 / 30240 + x * (1.0 / 1209600)));
  }
  return 1.0 / x - 0.5 / (angle * std::tan(0.5 * angle));
}

}  // namespace

Eigen::Quaterniond exponential(const Eigen::Vector3d& rotation_vector) noexcept {
  const double x = 0.25 * rotation_vector.squaredNorm();
  if (x == 0) return Eigen::Quaterniond::Identity();
  const HalfTurn turn = half_turn(x);
  Eigen::Quaterniond q;
  q.w() = turn.cosine;
  q.vec() = (0.5 * turn.sine_over_half) * rotation_vector;
  return q;
}

Eigen::Vector3d logarithm(const Eigen::Quaterniond& q) noexcept {
  const double s = q.vec().norm();
  if (s == 0) return Eigen::Vector3d::Zero();
  return std::copysign(2.0 * half_over_sine(s, std::abs(q.w())), q.w()) * q.vec();
}

double angle_between(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) noexcept {
  const Eigen::Quaterniond turn = a.conjugate() * b;
  const double s = turn.vec().norm();
  return s == 0 ? 0 : 2.0 * s * half_over_sine(s, std::abs(turn.w()));
}

Eigen::Vector3d angular_velocity_of(const Eigen::Vector3d& rotation_vector,
                                    const Eigen::Vector3d& rate) noexcept {
  const JacobianTerms terms = jacobian_terms(rotation_vector.norm());
  const Eigen::Vector3d once = rotation_vector.cross(rate);
  return rate - terms.cross * once + terms.twice * rotation_vector.cross(once);
}

Eigen::Vector3d rate_of_rotation_vector(const Eigen::Vector3d& rotation_vector,
                                        const Eigen::Vector3d& angular_velocity) noexcept {
  const double twice = inverse_jacobian_term(rotation_vector.norm());
  const Eigen::Vector3d once = rotation_vector.cross(angular_velocity);
  return angular_velocity + 0.5 * once + twice * rotation_vector.cross(once);
}

}  // namespace reckon::deadreckon
