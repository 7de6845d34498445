// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Random linear systems with poles and responses that are known before a matrix is made of them.
#pragma once

#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <complex>
#include <random>
#include <vector>

#include "reckon/bench/linear_systems/state_space.hpp"

namespace reckon::test {

using Random = std::mt19937_64;

inline double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

inline Eigen::MatrixXd random_orthogonal(Random& random, Eigen::Index n) {
  std::normal_distribution<double> normal;
  const Eigen::MatrixXd m = Eigen::MatrixXd::NullaryExpr(n, n, [&] { return normal(random); });
  return Eigen::HouseholderQR<Eigen::MatrixXd>(m).householderQ();
}

/// Block diagonal of a and b.
inline Eigen::MatrixXd joined(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(a.rows() + b.rows(), a.cols() + b.cols());
  all.topLeftCorner(a.rows(), a.cols()) = a;
  all.bottomRightCorner(b.rows(), b.cols()) = b;
  return all;
}

/// Real matrix with eigenvalue p, and its conjugate if p is not real.
inline Eigen::MatrixXd block_of(std::complex<double> p) {
  if (p.imag() == 0) return Eigen::MatrixXd::Constant(1, 1, p.real());
  Eigen::MatrixXd block(2, 2);
  block << p.real(), p.imag(), -p.imag(), p.real();
  return block;
}

/// G = direct + sum of residue/(x - pole) + conjugates of the complex ones.
struct ModeSum {
  double direct = 0.0;
  std::vector<std::complex<double>> poles, residues;

  std::complex<double> at(std::complex<double> x) const {
    std::complex<double> value = direct;
    for (std::size_t i = 0; i < poles.size(); ++i) {
      value += residues[i] / (x - poles[i]);
      if (poles[i].imag() != 0) value += std::conj(residues[i]) / (x - std::conj(poles[i]));
    }
    return value;
  }

  /// The same after a random orthogonal change of state.
  bench::StateSpace as_state_space(Random& random, double sample_period) const {
    Eigen::MatrixXd A(0, 0), B(0, 1), C(1, 0);
    for (std::size_t i = 0; i < poles.size(); ++i) {
      const Eigen::MatrixXd block = block_of(poles[i]);
      const Eigen::Index n = A.rows(), more = block.rows();
      A = joined(A, block);
      B.conservativeResize(n + more, 1);
      C.conservativeResize(1, n + more);
      // (x - p)^-1 in the basis (1, +-j): B = (1, 0), C = 2 (Re r, Im r) for a pair.
      B.bottomRows(more).setZero();
      B(n, 0) = 1;
      C(0, n) = (more == 2 ? 2 : 1) * residues[i].real();
      if (more == 2) C(0, n + 1) = 2 * residues[i].imag();
    }
    const Eigen::MatrixXd Q = random_orthogonal(random, A.rows());
    return {Q * A * Q.transpose(), Q * B, C * Q.transpose(),
            Eigen::MatrixXd::Constant(1, 1, direct), sample_period};
  }
};

/// One to four modes: sampled inside radius 0.99, continuous over three decades, damping >= 0.02.
inline ModeSum random_modes(Random& random, bool sampled) {
  std::normal_distribution<double> normal;
  ModeSum sum;
  const int modes = 1 + static_cast<int>(uniform(random, 0, 4));
  for (int i = 0; i < modes; ++i) {
    const bool real = uniform(random, 0, 1) < 0.4;
    const double size = std::pow(10.0, uniform(random, -1.5, 1.5));
    const double damping = uniform(random, 0.02, 0.9);
    std::complex<double> pole;
    if (sampled) {
      pole = std::polar(uniform(random, 0.1, 0.99), real ? 0.0 : uniform(random, 0.05, 3.0));
    } else {
      pole = real ? -size : size * std::complex<double>(-damping, std::sqrt(1 - damping * damping));
    }
    const double gain = sampled ? 1 - std::abs(pole) : std::abs(pole.real());
    sum.poles.push_back(pole);
    sum.residues.emplace_back(gain * normal(random), real ? 0.0 : gain * normal(random));
  }
  sum.direct = std::abs(normal(random)) * static_cast<double>(modes);
  return sum;
}

/// Least value of f over [low, high] by a dense grid and a second one around its lowest point.
template <typename F>
double least_of(const F& f, double low, double high) {
  constexpr int kPoints = 1500;
  double least = f(low), at = low;
  for (const double half : {high - low, (high - low) / kPoints}) {
    const double from = std::max(low, at - half), to = std::min(high, at + half);
    for (int i = 1; i <= kPoints; ++i) {
      const double x = from + (to - from) * i / kPoints, value = f(x);
      if (value < least) least = value, at = x;
    }
  }
  return least;
}

}  // namespace reckon::test
