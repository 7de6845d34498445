// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Linear systems on which eigenvectors fail, and measures that use only the definition.
#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <random>

#include "reckon/bench/linear_systems/state_space.hpp"
#include "reckon/bench/reduction/second_order_system.hpp"

namespace reckon::test {

/// 1/(s^2 + 2 zeta s + 1).
inline bench::StateSpace oscillator(double zeta) {
  bench::StateSpace system{Eigen::MatrixXd::Zero(2, 2), Eigen::MatrixXd::Zero(2, 1),
                           Eigen::MatrixXd::Zero(1, 2), Eigen::MatrixXd::Zero(1, 1), 0.0};
  system.A << 0.0, 1.0, -1.0, -2.0 * zeta;
  system.B(1, 0) = system.C(0, 0) = 1.0;
  return system;
}

/// (rate/(s + rate))^lags, each rate `spread` larger than the one before.
inline bench::StateSpace cascade(int lags, double rate, double spread) {
  bench::StateSpace system{Eigen::MatrixXd::Zero(lags, lags), Eigen::MatrixXd::Zero(lags, 1),
                           Eigen::MatrixXd::Zero(1, lags), Eigen::MatrixXd::Zero(1, 1), 0.0};
  for (int i = 0; i < lags; ++i) {
    const double own = rate * (1.0 + spread * i);
    system.A(i, i) = -own;
    if (i > 0) system.A(i, i - 1) = own;
  }
  system.B(0, 0) = rate;
  system.C(0, lags - 1) = 1.0;
  return system;
}

/// Displacement of probes to force through a contact spring at a body's points, in positions and
/// speeds: f = k (x - B^T q).
inline bench::StateSpace pressed(const bench::SecondOrderSystem& body, double stiffness) {
  const Eigen::Index n = body.size(), p = body.points();
  const Eigen::MatrixXd inverse = Eigen::MatrixXd(body.M).inverse();
  bench::StateSpace system{Eigen::MatrixXd::Zero(2 * n, 2 * n), Eigen::MatrixXd::Zero(2 * n, p),
                           Eigen::MatrixXd::Zero(p, 2 * n),
                           stiffness * Eigen::MatrixXd::Identity(p, p), 0.0};
  const Eigen::MatrixXd K = Eigen::MatrixXd(body.K) + stiffness * body.B * body.B.transpose();
  system.A.topRightCorner(n, n).setIdentity();
  system.A.bottomLeftCorner(n, n) = -inverse * K;
  system.A.bottomRightCorner(n, n) = -inverse * Eigen::MatrixXd(body.D);
  system.B.bottomRows(n) = stiffness * inverse * body.B;
  system.C.leftCols(n) = -stiffness * body.B.transpose();
  return system;
}

/// Stable, one input and one output: a random matrix moved left of the axis.
inline bench::StateSpace random_stable(std::mt19937& random, int order) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> unit(0, 1);
  const auto filled = [&](int rows, int columns) {
    return Eigen::MatrixXd(
        Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return normal(random); }));
  };
  const double speed = std::pow(10.0, 1.0 + 1.5 * unit(random));
  bench::StateSpace system{filled(order, order) * speed / std::sqrt(order),
                           filled(order, 1) * speed, filled(1, order), filled(1, 1), 0.0};
  const double rightmost = bench::poles(system).real().maxCoeff();
  system.A.diagonal().array() -= rightmost + (0.02 + 0.5 * unit(random)) * speed;
  return system;
}

/// Largest entry of G - H on the axis, by LU at each of many frequencies [rad/s].
inline double largest_difference(const bench::StateSpace& G, const bench::StateSpace& H,
                                 double lowest, double highest, double ratio = 1.05) {
  double most = 0.0;
  for (double w = lowest; w < highest; w *= ratio) {
    const std::complex<double> s(0.0, w);
    const double at = (bench::evaluate(G, s) - bench::evaluate(H, s)).cwiseAbs().maxCoeff();
    // NaN counts as the largest.
    if (!(at <= most)) most = at;
    if (std::isnan(most)) return HUGE_VAL;
  }
  return most;
}

}  // namespace reckon::test
