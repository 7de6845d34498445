// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/analysis/networked_pair.hpp"

#include <cmath>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "reckon/bench/linear_systems/stability.hpp"

namespace reckon::bench {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXd;

constexpr double kRounding = 1e-14;  // of the coefficients of a polynomial

TransferFunction wall_of(const PairParameters& p) {
  return virtual_wall(p.stiffness, p.wall_damping, p.sample_period, p.reading);
}

StateSpace device_of(const PairParameters& p) {
  if (!(p.mass > 0)) throw std::invalid_argument("networked pair: the mass must be above 0 kg");
  return discretise_zero_order_hold(to_state_space(mass_damper(p.mass, p.damping)),
                                    p.sample_period);
}

// One copy of the system for each of two users.
StateSpace for_both(const StateSpace& s) {
  const auto twice = [](const MatrixXd& m) {
    MatrixXd both = MatrixXd::Zero(2 * m.rows(), 2 * m.cols());
    both.topLeftCorner(m.rows(), m.cols()) = m;
    both.bottomRightCorner(m.rows(), m.cols()) = m;
    return both;
  };
  return {twice(s.A), twice(s.B), twice(s.C), twice(s.D), s.sample_period};
}

// u minus attenuation z^-d times the other's u.
StateSpace difference_of(const PairParameters& p) {
  MatrixXd crossed(2, 2);
  crossed << 0, -p.attenuation, -p.attenuation, 0;
  const double T = p.sample_period;
  return parallel(static_gain(MatrixXd::Identity(2, 2), T),
                  series(sample_delay(p.delay_samples, 2, T), static_gain(crossed, T)));
}

// 1 + factor z^-d, as polynomials.
TransferFunction echo_of(const PairParameters& p, double factor) {
  if (p.delay_samples < 0) {
    throw std::invalid_argument("networked pair: a delay must be 0 or more samples");
  }
  TransferFunction echo{{1}, {1}, p.sample_period};
  echo.numerator.resize(static_cast<std::size_t>(p.delay_samples) + 1);
  echo.denominator.resize(echo.numerator.size());
  echo.numerator.back() += factor;
  return echo;
}

// Whether z = 1 is a root, up to rounding: 1 - 1.6 + 0.6 of (z - 1)(z - 0.6) is not exactly 0.
// Below, the polynomial without this root.
bool has_root_at_one(const std::vector<double>& polynomial) {
  double value = 0.0, size = 0.0;
  for (const double coefficient : polynomial) {
    value += coefficient;
    size += std::abs(coefficient);
  }
  return std::abs(value) <= kRounding * size;
}
std::vector<double> without_root_at_one(std::vector<double> polynomial) {
  std::partial_sum(polynomial.begin(), polynomial.end(), polynomial.begin());
  polynomial.pop_back();
  return polynomial;
}

// In each mode of motion both users have the environment with an echo. If the echo cancels the
// integrator, no motion of this mode reaches the integrator's state, so the state is removed.
double mode_radius(const PairParameters& p, TransferFunction environment, double factor) {
  TransferFunction echo = echo_of(p, factor);
  if (has_root_at_one(echo.numerator) && has_root_at_one(environment.denominator)) {
    echo.numerator = without_root_at_one(std::move(echo.numerator));
    environment.denominator = without_root_at_one(std::move(environment.denominator));
  }
  const TransferFunction both = product(environment, echo);
  return spectral_radius(feedback(device_of(p), to_state_space(both)));
}

double mass_and_damping(const PairParameters& p) { return p.mass + p.damping * p.sample_period; }

}  // namespace

Eigen::Matrix2cd printed_pair(const PairParameters& p, double theta) {
  const Complex z = std::polar(1.0, theta);
  const Complex device =
      evaluate(backward_difference_device(p.mass, p.damping, p.device_gain, p.sample_period), z);
  const Complex across = -device * evaluate(wall_of(p), z) * printed_hold(theta) * device / z;
  Eigen::Matrix2cd G;
  G << device, across, across, device;
  return G;
}

Eigen::Matrix2cd closed_pair(Complex device, Complex environment, Complex delay) {
  const Complex loop = device * environment;
  const Complex P = device / (1.0 + loop), Q = delay * loop / (1.0 + loop);
  Eigen::Matrix2cd closed;
  closed << P, Q * P, Q * P, P;
  return closed / (1.0 - Q * Q);
}

StateSpace pair_loop(const PairParameters& p) {
  const StateSpace devices = for_both(device_of(p));
  const StateSpace environments = series(difference_of(p), for_both(to_state_space(wall_of(p))));
  // The forces are outputs of the states of the loop: devices first, then environments.
  StateSpace loop = feedback(devices, environments);
  const Eigen::Index n = devices.order(), all = loop.order();
  MatrixXd forces = MatrixXd::Zero(2, all);
  forces.leftCols(n) = environments.D * devices.C;
  forces.rightCols(all - n) = environments.C;
  loop.C.conservativeResize(4, all);
  loop.C.bottomRows(2) = forces;
  loop.D = MatrixXd::Zero(4, 2);
  return loop;
}

PairRadii pair_radii(const PairParameters& p) { return pair_radii(p, wall_of(p)); }

PairRadii pair_radii(const PairParameters& p, const TransferFunction& environment) {
  return {mode_radius(p, environment, -p.attenuation), opposed_radius(p, environment)};
}

double opposed_radius(const PairParameters& p) { return opposed_radius(p, wall_of(p)); }

double opposed_radius(const PairParameters& p, const TransferFunction& environment) {
  return mode_radius(p, environment, p.attenuation);
}

double printed_scale(const PairParameters& p, double theta) {
  const double M = mass_and_damping(p), c = std::cos(theta);
  const double below = M * M - 2 * p.mass * M * c + p.mass * p.mass;
  const double TK = p.sample_period * p.device_gain;
  return TK * TK / (4 * (1 - c) * below * below);
}

Complex direct_g12(const PairParameters& p, double theta) {
  return printed_pair(p, theta)(0, 1) / printed_scale(p, theta);
}

Complex corrected_g12(const PairParameters& p, double theta) {
  const double m = p.mass, M = mass_and_damping(p), b_e = p.wall_damping, w = theta;
  const double KT = p.stiffness * (p.reading == SpringReading::with_period ? p.sample_period : 1.0);
  const double c = std::cos(w), s = std::sin(w), c2 = std::cos(2 * w), s2 = std::sin(2 * w);
  const double re = -2 * b_e * (1 - c) * (M * M * (c + c2) - m * (2 * M - m) * (1 + c)) +
                    2 * KT * (M * M - m * m) * s * s;
  const double im = 2 * b_e * (1 - c) * (M * M * (s + s2) - 2 * M * m * s - m * m * s) +
                    KT * ((M * M + m * m) * s2 - 4 * M * m * s);
  return {re, im};
}

Complex printed_g12(const PairParameters& p, double theta) {
  const double m = p.mass, M = mass_and_damping(p), b_e = p.wall_damping, w = theta;
  const double KeT = p.stiffness * p.sample_period;
  const double c = std::cos(w), s = std::sin(w), c2 = std::cos(2 * w), s2 = std::sin(2 * w);
  const double re = 4 * m * M * s * s * (b_e + KeT) - 2 * m * m * b_e * s * s -
                    M * M * (2 * b_e * (1 - c) * (c - c2) + KeT * (c - std::cos(3 * w)));
  const double im = 2 * m * KeT * M * s2 - m * m * 2 * b_e * s * (1 - c) - 2 * m * m * KeT * s -
                    4 * m * b_e * M * (1 - c) * s +
                    M * M * (2 * b_e * (s + s2) * (1 - c) + KeT * (s - std::sin(3 * w)));
  return {re, im};
}

double unconditional_margin(const PairParameters& p, double theta) {
  const Eigen::Matrix2cd G = printed_pair(p, theta);
  return G(0, 0).real() * G(1, 1).real() - std::norm(G(0, 1));
}

}  // namespace reckon::bench
