// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/linear_systems/positive_real.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>
#include <vector>

#include "reckon/bench/linear_systems/border_poles.hpp"

namespace reckon::bench {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;

constexpr double kPi = std::numbers::pi;
constexpr double kRounding = 1e-11;
constexpr int kRounds = 20;
constexpr int kGrid = 16;
constexpr double kPressed = 0.2;  // sine of an angle; the map's resolution is too low below it

struct Sample {
  double angle = 0.0;  // or frequency
  double value = std::numeric_limits<double>::infinity();
};

double least_eigenvalue(const MatrixXcd& hermitian) {
  if (hermitian.rows() == 1) return hermitian(0, 0).real();
  return Eigen::SelfAdjointEigenSolver<MatrixXcd>(hermitian, Eigen::EigenvaluesOnly)
      .eigenvalues()(0);
}

// The least value over the half circle [0, pi]: coefficients are real, and the other half is its
// mirror image.
class LeastOnCircle {
 public:
  explicit LeastOnCircle(const CircleSystem& system) : system_(system) {
    for (const BorderPole& pole : system.border) {
      size_ = std::max(size_, pole.residue.cwiseAbs().maxCoeff());
    }
  }

  Sample find() {
    std::vector<double> angles = {0.0, kPi};
    for (int i = 1; i < kGrid; ++i) angles.push_back(kPi * i / kGrid);
    for (Eigen::Index i = 0; i < system_.A.rows(); ++i)
      angles.push_back(std::abs(std::arg(system_.A(i, i))));
    visit(angles);
    for (int round = 0; round < kRounds; ++round) {
      const double before = best_.value;
      visit(level_angles(before - kRounding * size_));
      refine();
      if (best_.value >= before - kRounding * size_) break;
    }
    return best_;
  }

  /// Greatest entry so far, residues included: the reference for rounding errors.
  [[nodiscard]] double size() const { return size_; }

 private:
  double evaluate(double angle) {
    const MatrixXcd G = system_.response(angle);
    const double value = least_eigenvalue(0.5 * (G + G.adjoint()));
    size_ = std::max(size_, G.cwiseAbs().maxCoeff());
    if (value < best_.value) best_ = {angle, value};
    if (value > highest_.value || std::isinf(highest_.value)) highest_ = {angle, value};
    return value;
  }

  // Evaluates at the angles and halfway between neighbours.
  void visit(std::vector<double> angles) {
    std::sort(angles.begin(), angles.end());
    for (std::size_t i = 0; i < angles.size(); ++i) {
      evaluate(angles[i]);
      if (i > 0) evaluate(0.5 * (angles[i - 1] + angles[i]));
    }
    angles_ = std::move(angles);
  }

  // Angles in [0, pi] near which an eigenvalue of the Hermitian part may equal `level`. The point
  // at infinity of the half-plane is mapped to the place where the value is farthest above the
  // level, so that the Hamiltonian's inverse exists. Eigenvalues off the axis are kept too: they
  // cost two evaluations each, and a crossing that rounding moved off the axis is not lost.
  std::vector<double> level_angles(double level) const {
    std::vector<double> angles = {0.0, kPi};
    const Index n = system_.A.rows(), ports = system_.D.rows();
    if (n == 0) return angles;
    const Complex turn = -std::polar(1.0, highest_.angle);
    const MatrixXcd unit = MatrixXcd::Identity(n, n);
    const MatrixXcd A = system_.A / turn, B = system_.B / turn;
    const Eigen::PartialPivLU<MatrixXcd> lu(A + unit);
    const MatrixXcd As = lu.solve(A - unit);
    const MatrixXcd Bs = std::sqrt(2.0) * lu.solve(B);
    const MatrixXcd Cs = std::sqrt(2.0) * system_.C * lu.inverse();
    const MatrixXcd Ds = system_.D - system_.C * lu.solve(B);

    MatrixXcd R = Ds + Ds.adjoint();
    R.diagonal().array() -= 2 * level;
    MatrixXcd in(2 * n, ports), out(ports, 2 * n);
    in << Bs, Cs.adjoint();
    out << Cs, -Bs.adjoint();
    MatrixXcd hamiltonian = -in * R.partialPivLu().solve(out);
    hamiltonian.topLeftCorner(n, n) += As;
    hamiltonian.bottomRightCorner(n, n) -= As.adjoint();
    if (!hamiltonian.allFinite())
      return angles;  // R is singular: the value equals the level everywhere

    const Eigen::ComplexEigenSolver<MatrixXcd> solver(hamiltonian, false);
    for (const Complex s : solver.eigenvalues()) {
      const double angle = std::abs(std::arg(turn * (1.0 + s) / (1.0 - s)));
      if (std::isfinite(angle)) angles.push_back(angle);
    }
    return angles;
  }

  // Golden section between the neighbours of the best angle so far, down to rounding. Far above or
  // below the middle of the poles a whole resonance may lie within 1e-9 rad.
  void refine() {
    constexpr double kGolden = 0.6180339887498949;
    double low = 0.0, high = kPi;
    for (const double a : angles_) {
      if (a < best_.angle) low = std::max(low, a);
      if (a > best_.angle) high = std::min(high, a);
    }
    double left = high - kGolden * (high - low), right = low + kGolden * (high - low);
    double at_left = evaluate(left), at_right = evaluate(right);
    for (int i = 0; i < 80 && high - low > 4e-16 * high; ++i) {
      if (at_left < at_right) {
        high = right, right = left, at_right = at_left;
        left = high - kGolden * (high - low), at_left = evaluate(left);
      } else {
        low = left, left = right, at_left = at_right;
        right = low + kGolden * (high - low), at_right = evaluate(right);
      }
    }
  }

  const CircleSystem& system_;
  Sample best_, highest_;
  double size_ = 0.0;
  std::vector<double> angles_;
};

// The least value again, where the map to the circle compresses frequencies: there a narrow dip far
// from the middle of the poles is blurred. Golden section over its width, on the axis itself.
Sample polished(const StateSpace& model, double angular_frequency) {
  constexpr double kGolden = 0.6180339887498949;
  const FrequencyResponse response(model);
  Sample best;
  const auto evaluate = [&](double w) {
    const MatrixXcd G = response.at_frequency(w);
    const double value = least_eigenvalue(0.5 * (G + G.adjoint()));
    if (value < best.value) best = {w, value};
    return value;
  };
  evaluate(angular_frequency);
  double width = angular_frequency;
  for (const Complex p : poles(model)) {
    width = std::min(width, std::abs(Complex(0, angular_frequency) - p));
  }
  double low = angular_frequency - width, high = angular_frequency + width;
  double left = high - kGolden * (high - low), right = low + kGolden * (high - low);
  double at_left = evaluate(left), at_right = evaluate(right);
  for (int i = 0; i < 60; ++i) {
    if (at_left < at_right) {
      high = right, right = left, at_right = at_left;
      left = high - kGolden * (high - low), at_left = evaluate(left);
    } else {
      low = left, left = right, at_left = at_right;
      right = low + kGolden * (high - low), at_right = evaluate(right);
    }
  }
  return best;
}

// The fault of a pole by itself, if there is one.
ActiveBecause fault_of(const BorderPole& pole, double size) {
  if (!pole.simple) return ActiveBecause::multiple_pole;
  const double rounding = 1e-9 * size;
  const bool hermitian = (pole.residue - pole.residue.adjoint()).cwiseAbs().maxCoeff() <= rounding;
  const bool good =
      hermitian && least_eigenvalue(0.5 * (pole.residue + pole.residue.adjoint())) >= -rounding;
  return good ? ActiveBecause::nothing : ActiveBecause::residue;
}

PositiveRealReport active(ActiveBecause because, double angular_frequency) {
  return {because, -std::numeric_limits<double>::infinity(), std::abs(angular_frequency)};
}

}  // namespace

PositiveRealReport judge_positive_real(const StateSpace& model) {
  const CircleSystem system = on_unit_circle(model);
  if (system.beyond) return active(ActiveBecause::pole_beyond_border, *system.beyond);
  for (const BorderPole& pole : system.border) {
    if (!pole.simple) return active(ActiveBecause::multiple_pole, system.frequency_of(pole.angle));
  }

  LeastOnCircle search(system);
  const Sample least = search.find();
  for (const BorderPole& pole : system.border) {
    const ActiveBecause fault = fault_of(pole, search.size());
    if (fault != ActiveBecause::nothing) return active(fault, system.frequency_of(pole.angle));
  }
  double value = least.value, frequency = system.frequency_of(least.angle);
  const bool is_pressed = std::abs(std::sin(least.angle)) < kPressed;
  if (!model.is_sampled() && is_pressed && system.border.empty() && frequency > 0 &&
      std::isfinite(frequency)) {
    const Sample better = polished(model, frequency);
    value = better.value;
    frequency = better.angle;
  }
  const bool negative = value < -kRounding * search.size();
  return {negative ? ActiveBecause::negative_real_part : ActiveBecause::nothing, value, frequency};
}

PositiveRealReport judge_positive_real(const TransferFunction& model) {
  const TransferFunction h = checked(model);
  if (h.numerator.size() == h.denominator.size() + 1) {
    return judge_positive_real(to_state_space(inverse(h)));
  }
  if (h.numerator.size() > h.denominator.size() + 1) {
    return active(ActiveBecause::multiple_pole, std::numeric_limits<double>::infinity());
  }
  return judge_positive_real(to_state_space(h));
}

std::string describe(const PositiveRealReport& report) {
  constexpr const char* kWords[] = {
      "positive real", "pole beyond the border", "multiple pole on the border",
      "pole on the border with a residue that is not positive", "negative real part"};
  std::ostringstream text;
  text << kWords[static_cast<int>(report.because)];
  if (std::isfinite(report.least)) text << ", " << report.least;
  text << " at " << report.angular_frequency << " rad/s";
  return text.str();
}

}  // namespace reckon::bench
