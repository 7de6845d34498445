// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Comparison for the extrapolation of RVB: random entities, a reference for the error, and two
// plain implementations.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>

#include "reckon/deadreckon/motion/kinematic_state.hpp"
#include "reckon/deadreckon/motion/rotation.hpp"

namespace reckon::bench {

using deadreckon::exponential;
using deadreckon::KinematicState;
using deadreckon::Pose;
using Algorithm = pdu::DeadReckoningAlgorithm;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

inline constexpr std::size_t kStates = 256;
inline constexpr double kTau = 2.0;
using States = std::array<KinematicState, kStates>;

// Entities at 100 m/s and 20 m/s^2 that turn at `rate` [rad/s].
inline States states(Algorithm algorithm, double rate) {
  std::mt19937 engine(1);
  std::normal_distribution<double> normal;
  const auto direction = [&] {
    return Vector3d(normal(engine), normal(engine), normal(engine)).normalized();
  };
  States all;
  for (KinematicState& s : all) {
    s.algorithm = algorithm;
    s.position = 1000 * direction();
    s.orientation = exponential(direction());
    s.velocity = 100 * direction();
    s.acceleration = 20 * direction();
    s.angular_velocity = rate * direction();
  }
  return all;
}

// Runge-Kutta in long double of P' = R (V + A t), R' = R [w]x.
class Reference {
 public:
  using Vector = Eigen::Matrix<long double, 3, 1>;
  using Matrix = Eigen::Matrix<long double, 3, 3>;
  explicit Reference(const KinematicState& s)
      : velocity_(s.velocity.cast<long double>()),
        acceleration_(s.acceleration.cast<long double>()),
        rotation_(s.orientation.toRotationMatrix().cast<long double>()),
        position_(s.position.cast<long double>()) {
    const Vector w = s.angular_velocity.cast<long double>();
    skew_ << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
  }
  Vector3d position_at(double tau) {
    constexpr int kSteps = 3000;
    const long double h = static_cast<long double>(tau) / kSteps;
    for (int i = 0; i < kSteps; ++i) step(h * i, h);
    return position_.cast<double>();
  }

 private:
  Vector rate(const Matrix& r, long double t) const { return r * (velocity_ + t * acceleration_); }
  void step(long double t, long double h) {
    // The position needs the rotation at start, middle and end of the step: Simpson's rule.
    const Matrix middle = turned(rotation_, h / 2), end = turned(middle, h / 2);
    position_ += h / 6 * (rate(rotation_, t) + 4 * rate(middle, t + h / 2) + rate(end, t + h));
    rotation_ = end;
  }
  Matrix turned(const Matrix& r, long double h) const {
    const Matrix a = h * skew_;
    return r + r * (a + a * a / 2 + a * a * a / 6 + a * a * a * a / 24);
  }

  Vector velocity_, acceleration_;
  Matrix rotation_, skew_;
  Vector position_;
};

// The closed form as printed and commonly implemented: matrices, and a check for exactly zero.
inline Pose textbook_rvb(const KinematicState& s, double t) {
  const Vector3d& w = s.angular_velocity;
  const double n = w.norm();
  Pose pose;
  Matrix3d r1 = t * Matrix3d::Identity(), r2 = 0.5 * t * t * Matrix3d::Identity();
  pose.orientation = s.orientation;
  if (n > 0) {
    Matrix3d skew;
    skew << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
    const double x = n * t, sine = std::sin(x), cosine = std::cos(x);
    const Matrix3d outer = w * w.transpose();
    r1 = (x - sine) / std::pow(n, 3) * outer + sine / n * Matrix3d::Identity() +
         (1 - cosine) / (n * n) * skew;
    r2 = (0.5 * x * x - cosine - x * sine + 1) / std::pow(n, 4) * outer +
         (cosine + x * sine - 1) / (n * n) * Matrix3d::Identity() +
         (sine - x * cosine) / std::pow(n, 3) * skew;
    pose.orientation = s.orientation * Eigen::AngleAxisd(x, w / n);
  }
  const Matrix3d r0 = s.orientation.toRotationMatrix();
  pose.position = s.position + r0 * (r1 * s.velocity + r2 * s.acceleration);
  pose.velocity = pose.orientation * (s.velocity + t * s.acceleration);
  pose.angular_velocity = w;
  return pose;
}

// Velocity rotated once at the update, as in a second-order extrapolator without R1 and R2.
inline Pose straight_rvb(const KinematicState& s, double t) {
  Pose pose;
  pose.position = s.position + s.orientation * (t * s.velocity + 0.5 * t * t * s.acceleration);
  pose.orientation = s.orientation * exponential(t * s.angular_velocity);
  pose.velocity = pose.orientation * (s.velocity + t * s.acceleration);
  pose.angular_velocity = s.angular_velocity;
  return pose;
}

}  // namespace reckon::bench
