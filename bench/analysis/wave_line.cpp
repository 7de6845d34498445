// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/analysis/wave_line.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <complex>
#include <stdexcept>

namespace reckon::bench {
namespace {

using Complex = std::complex<double>;

void require(bool good, const char* what) {
  if (!good) throw std::invalid_argument(std::string("transmission line: ") + what);
}

}  // namespace

TwoPortMatrix delayed_junction(double theta) {
  const Complex late = std::polar(1.0, -theta);
  Eigen::Matrix2cd H;
  H << 0.0, late, -late, 0.0;
  return {PortForm::inverse_hybrid, H};
}

Eigen::Vector2d power_eigenvalues(const TwoPortMatrix& immittance) {
  require(immittance.form != PortForm::chain, "a chain matrix has no power form; convert it");
  const Eigen::Matrix2cd sum = immittance.matrix + immittance.matrix.adjoint();
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix2cd>(sum, Eigen::EigenvaluesOnly).eigenvalues();
}

LineParameters line_of(double mass, double stiffness) {
  require(mass > 0 && stiffness > 0, "mass and stiffness must be above 0");
  return {std::sqrt(mass * stiffness), std::sqrt(mass / stiffness)};
}

TwoPortMatrix transmission_line(const LineParameters& line, double angular_frequency) {
  const double wT = angular_frequency * line.delay;
  const Complex coth(0.0, -line.impedance / std::tan(wT)),
      csch(0.0, -line.impedance / std::sin(wT));
  Eigen::Matrix2cd Z;
  Z << coth, csch, csch, coth;
  return {PortForm::impedance, Z};
}

TwoPortMatrix printed_transmission_line(const LineParameters& line, double angular_frequency) {
  const Complex lambda = std::polar(1.0, -angular_frequency * line.delay);
  const Complex diagonal = line.impedance * (lambda * lambda + 1.0) / (lambda * lambda - 1.0);
  const Complex across = line.impedance * 2.0 * lambda / (1.0 - lambda * lambda);
  Eigen::Matrix2cd Z;
  Z << diagonal, across, across, diagonal;
  return {PortForm::impedance, Z};
}

WaveLine::WaveLine(double impedance, int delay_samples, double sample_period)
    : root_(std::sqrt(impedance)), sample_period_(sample_period) {
  require(impedance > 0 && std::isfinite(impedance), "the impedance must be above 0 N s/m");
  require(delay_samples >= 1, "the delay must be 1 or more samples");
  require(sample_period > 0 && std::isfinite(sample_period), "the sample period must be above 0 s");
  on_the_way_.resize(static_cast<std::size_t>(delay_samples));
}

WaveLine::Ends WaveLine::step(const Ends& flows) {
  Ends& place = on_the_way_[oldest_];
  const Ends arrived{place.b, place.a};  // at a: the wave that left b
  place = {root_ * flows.a + arrived.a, root_ * flows.b + arrived.b};
  oldest_ = (oldest_ + 1) % on_the_way_.size();
  // F = Z V + 2 sqrt Z v.
  return {root_ * (root_ * flows.a + 2 * arrived.a), root_ * (root_ * flows.b + 2 * arrived.b)};
}

double WaveLine::stored() const {
  double sum = 0.0;
  for (const Ends& w : on_the_way_) sum += w.a * w.a + w.b * w.b;
  return sum * sample_period_;
}

}  // namespace reckon::bench
