// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/analysis/two_port.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

namespace reckon::bench {
namespace {

using Complex = std::complex<double>;
using Eigen::Matrix2cd;

// The outputs and inputs of a form among (F1, V1, F2, V2), and the sign of its second input.
struct FormRow {
  const char* name;
  std::array<Eigen::Index, 2> out, in;
  double sign;
};

constexpr FormRow kForms[] = {
    {"impedance", {0, 2}, {1, 3}, 1.0}, {"admittance", {1, 3}, {0, 2}, 1.0},
    {"hybrid", {0, 3}, {1, 2}, 1.0},    {"inverse hybrid", {1, 2}, {0, 3}, 1.0},
    {"chain", {0, 1}, {2, 3}, -1.0},
};

const FormRow& row_of(PortForm form) { return kForms[static_cast<std::size_t>(form)]; }

}  // namespace

Complex OnePort::impedance_at(double angular_frequency) const {
  const Complex value =
      evaluate(system, border_point(system.sample_period, angular_frequency))(0, 0);
  return causality == Causality::impedance ? value : 1.0 / value;
}

Complex OnePort::admittance_at(double angular_frequency) const {
  return 1.0 / impedance_at(angular_frequency);
}

// Every form is two equations of the four quantities; solving them for two other quantities gives
// another form.
TwoPortMatrix converted(const TwoPortMatrix& two_port, PortForm form) {
  if (!two_port.matrix.allFinite()) {
    throw std::invalid_argument("two-port: an entry is not finite; is the frequency a pole?");
  }
  if (form == two_port.form) return two_port;
  const FormRow &from = row_of(two_port.form), &to = row_of(form);
  Eigen::Matrix<Complex, 2, 4> equations = Eigen::Matrix<Complex, 2, 4>::Zero();
  for (std::size_t i = 0; i < 2; ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    equations(column, from.out[i]) = 1.0;
    equations.col(from.in[i]) = -two_port.matrix.col(column) * (i == 1 ? from.sign : 1.0);
  }
  Matrix2cd given, taken;
  for (std::size_t i = 0; i < 2; ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    given.col(column) = equations.col(to.out[i]);
    taken.col(column) = -equations.col(to.in[i]) * (i == 1 ? to.sign : 1.0);
  }
  const Complex determinant = given.determinant();
  const double size = given.cwiseAbs().maxCoeff();
  if (!(std::abs(determinant) > 1e-15 * size * std::max(size, 1e-300))) {
    throw std::invalid_argument(std::string("two-port: it has no ") + to.name +
                                " form at this frequency; use another form");
  }
  return {form, given.inverse() * taken};
}

TwoPortMatrix cascade(const TwoPortMatrix& first, const TwoPortMatrix& second) {
  return {PortForm::chain,
          converted(first, PortForm::chain).matrix * converted(second, PortForm::chain).matrix};
}

Complex driving_impedance(const TwoPortMatrix& two_port, Complex load) {
  const Matrix2cd c = converted(two_port, PortForm::chain).matrix;
  // At the load, F2 = load (-V2).
  return (c(0, 0) * load + c(0, 1)) / (c(1, 0) * load + c(1, 1));
}

TwoPortMatrix TwoPort::at(double angular_frequency) const {
  return {form, evaluate(system, border_point(system.sample_period, angular_frequency))};
}

double passivity_margin(const Matrix2cd& P) {
  const double p11 = P(0, 0).real(), p22 = P(1, 1).real();
  return std::min({p11, p22, p11 * p22 - std::norm(0.5 * (P(1, 0) + std::conj(P(0, 1))))});
}

double printed_passivity_margin(const Matrix2cd& P) {
  const double p11 = P(0, 0).real(), p22 = P(1, 1).real();
  return std::min({p11, p22, p11 * p22 - std::norm(0.5 * (P(1, 0) + P(0, 1)))});
}

double llewellyn_margin(const Matrix2cd& P) {
  const double p11 = P(0, 0).real(), p22 = P(1, 1).real();
  const Complex across = P(0, 1) * P(1, 0);
  return std::min({p11, p22, 2 * p11 * p22 - across.real() - std::abs(across)});
}

}  // namespace reckon::bench
