// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The motion of a turning body by quadrature in long double: the reference of the dead-reckoning
// models. Shares no formula with deadreckon/: the rotation is the power series of the matrix
// exponential, the displacement is a sum over Gauss-Legendre nodes.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace reckon::deadreckon::test {

using Real = long double;
using RealVector = Eigen::Matrix<Real, 3, 1>;
using RealMatrix = Eigen::Matrix<Real, 3, 3>;

/// exp([v]x) as the plain power series; |v| at most a few radians.
inline RealMatrix matrix_exponential(const RealVector& v) {
  RealMatrix skew;
  skew << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  RealMatrix sum = RealMatrix::Identity(), power = RealMatrix::Identity();
  for (int n = 1; n < 60; ++n) {
    power = power * skew / n;
    sum += power;
    if (power.lpNorm<Eigen::Infinity>() < 1e-23L) break;
  }
  return sum;
}

/// Body to reference, from the wire's angles: about z, the new y, the new x.
inline RealMatrix body_to_reference(Real psi, Real theta, Real phi) {
  const RealMatrix z = matrix_exponential({0, 0, psi});
  const RealMatrix y = matrix_exponential({0, theta, 0});
  const RealMatrix x = matrix_exponential({phi, 0, 0});
  return z * y * x;
}

inline constexpr std::size_t kNodes = 8;

/// Node on [-1, 1] and weight.
using Node = std::pair<Real, Real>;

/// Gauss-Legendre nodes: the zeros of the Legendre polynomial, by Newton's method.
inline const std::array<Node, kNodes>& gauss_legendre() {
  static const std::array<Node, kNodes> nodes = [] {
    std::array<Node, kNodes> made;
    constexpr auto n = static_cast<Real>(kNodes);
    for (std::size_t i = 0; i < kNodes; ++i) {
      Real x = std::cos(3.14159265358979323846L * (static_cast<Real>(i) + 0.75L) / (n + 0.5L));
      Real slope = 1;
      for (int round = 0; round < 12; ++round) {
        Real before = 1, value = x;
        for (std::size_t k = 2; k <= kNodes; ++k) {
          const auto degree = static_cast<Real>(k);
          before =
              std::exchange(value, ((2 * degree - 1) * x * value - (degree - 1) * before) / degree);
        }
        slope = n * (x * value - before) / (x * x - 1);
        x -= value / slope;
      }
      made[i] = {x, 2 / ((1 - x * x) * slope * slope)};
    }
    return made;
  }();
  return nodes;
}

/// A body that turns at a constant rate for `time`.
class TurningBody {
 public:
  /// Panels of at most one radian, and `finer` times as many.
  TurningBody(const RealVector& rate, Real time, int finer = 1)
      : panels_(finer * (1 + static_cast<int>(rate.norm() * std::abs(time)))),
        panel_(time / panels_),
        turn_(matrix_exponential(panel_ * rate)) {
    for (std::size_t i = 0; i < kNodes; ++i) {
      at_[i] = panel_ * (1 + gauss_legendre()[i].first) / 2;
      turned_[i] = matrix_exponential(at_[i] * rate);
      weight_[i] = panel_ * gauss_legendre()[i].second / 2;
    }
    for (int i = 0; i < panels_; ++i) end_ = end_ * turn_;
  }

  /// Body axes at the end, in the axes of the start.
  [[nodiscard]] const RealMatrix& rotation() const { return end_; }

  /// The integral of R(s) (v + a s) from 0 to `time`, in the axes of the start.
  [[nodiscard]] RealVector way(const RealVector& v, const RealVector& a) const {
    RealVector sum = RealVector::Zero();
    RealMatrix rotation = RealMatrix::Identity();
    for (int i = 0; i < panels_; ++i) {
      const Real start = i * panel_;
      RealVector part = RealVector::Zero();
      for (std::size_t k = 0; k < kNodes; ++k)
        part += weight_[k] * (turned_[k] * (v + (start + at_[k]) * a));
      sum += rotation * part;
      rotation = rotation * turn_;
    }
    return sum;
  }

 private:
  int panels_;
  Real panel_;
  RealMatrix turn_;
  RealMatrix end_ = RealMatrix::Identity();
  std::array<Real, kNodes> at_{}, weight_{};
  std::array<RealMatrix, kNodes> turned_;
};

/// Angle between two rotation matrices, accurate when it is small.
inline Real angle_between(const RealMatrix& a, const RealMatrix& b) {
  const RealMatrix c = a.transpose() * b;
  const RealVector axis(c(2, 1) - c(1, 2), c(0, 2) - c(2, 0), c(1, 0) - c(0, 1));
  return std::atan2(axis.norm(), c.trace() - 1);
}

/// The rotation of a quaternion (w, x, y, z) of any non-zero length.
template <typename Quaternion>
RealMatrix rotation_of(const Quaternion& q) {
  const Real w = q.w(), x = q.x(), y = q.y(), z = q.z();
  const Real s = 2 / (w * w + x * x + y * y + z * z);
  RealMatrix m;
  m << 1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y),  //
      s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x),   //
      s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y);
  return m;
}

}  // namespace reckon::deadreckon::test
