// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/linear_systems/transfer_function.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <unsupported/Eigen/Polynomials>

namespace reckon::bench {
namespace {

using Polynomial = std::vector<double>;
using Complex = std::complex<double>;

void require(bool good, const char* what) {
  if (!good) throw std::invalid_argument(std::string("transfer function: ") + what);
}

bool is_finite(const Polynomial& p) {
  return std::all_of(p.begin(), p.end(), [](double c) { return std::isfinite(c); });
}

Polynomial without_leading_zeros(Polynomial p) {
  p.erase(p.begin(), std::find_if(p.begin(), p.end(), [](double c) { return c != 0; }));
  return p;
}

Polynomial multiply(const Polynomial& a, const Polynomial& b) {
  if (a.empty() || b.empty()) return {};
  Polynomial result(a.size() + b.size() - 1, 0.0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t k = 0; k < b.size(); ++k) result[i + k] += a[i] * b[k];
  }
  return result;
}

Polynomial add(Polynomial a, Polynomial b) {
  if (a.size() < b.size()) std::swap(a, b);
  const std::size_t shift = a.size() - b.size();
  for (std::size_t i = 0; i < b.size(); ++i) a[shift + i] += b[i];
  return a;
}

Complex horner(const Polynomial& p, Complex point) {
  Complex value = 0;
  for (const double c : p) value = value * point + c;
  return value;
}

void require_same_period(const TransferFunction& a, const TransferFunction& b) {
  require(a.sample_period == b.sample_period,
          "sample periods differ; both must have one, or both be in s");
}

}  // namespace

TransferFunction checked(TransferFunction h) {
  require(is_finite(h.numerator) && is_finite(h.denominator),
          "a coefficient is not finite; mend the model");
  require(h.sample_period >= 0 && std::isfinite(h.sample_period),
          "the sample period must be a finite number >= 0 s (0: in s)");
  h.numerator = without_leading_zeros(std::move(h.numerator));
  h.denominator = without_leading_zeros(std::move(h.denominator));
  require(!h.denominator.empty(), "the denominator is zero");
  const double lead = h.denominator.front();
  for (double& c : h.numerator) c /= lead;
  for (double& c : h.denominator) c /= lead;
  require(is_finite(h.numerator) && is_finite(h.denominator),
          "the denominator's first coefficient is too small beside the others; scale the model");
  return h;
}

Complex evaluate(const TransferFunction& h, Complex point) {
  return horner(h.numerator, point) / horner(h.denominator, point);
}

Eigen::VectorXcd roots(const Polynomial& polynomial) {
  Polynomial p = without_leading_zeros(polynomial);
  require(!p.empty() && is_finite(p), "roots are those of a finite polynomial that is not zero");
  const auto degree = static_cast<Eigen::Index>(p.size()) - 1;
  Eigen::VectorXcd result = Eigen::VectorXcd::Zero(degree);
  while (p.back() == 0) p.pop_back();  // roots at 0
  if (p.size() < 2) return result;

  std::reverse(p.begin(), p.end());
  const Eigen::Map<const Eigen::VectorXd> ascending(p.data(), static_cast<Eigen::Index>(p.size()));
  const Eigen::PolynomialSolver<double, Eigen::Dynamic> solver(ascending);
  result.head(ascending.size() - 1) = solver.roots();
  return result;
}

Eigen::VectorXcd poles(const TransferFunction& h) { return roots(h.denominator); }
Eigen::VectorXcd zeros(const TransferFunction& h) { return roots(h.numerator); }

StateSpace to_state_space(const TransferFunction& h) {
  const TransferFunction f = checked(h);
  require(f.numerator.size() <= f.denominator.size(),
          "the numerator's degree is above the denominator's, which has no state form; "
          "take the inverse (an admittance for an impedance)");
  const auto n = static_cast<Eigen::Index>(f.denominator.size()) - 1;
  Polynomial b(f.denominator.size() - f.numerator.size(), 0.0);
  b.insert(b.end(), f.numerator.begin(), f.numerator.end());

  StateSpace s{Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, 1),
               Eigen::MatrixXd::Zero(1, n), Eigen::MatrixXd::Constant(1, 1, b[0]), f.sample_period};
  if (n == 0) return s;
  s.A.bottomLeftCorner(n - 1, n - 1).setIdentity();
  s.B(0, 0) = 1;
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i) + 1;
    s.A(0, i) = -f.denominator[k];
    s.C(0, i) = b[k] - b[0] * f.denominator[k];
  }
  return s;
}

TransferFunction sum(const TransferFunction& a, const TransferFunction& b) {
  require_same_period(a, b);
  if (a.denominator == b.denominator) {
    return checked({add(a.numerator, b.numerator), a.denominator, a.sample_period});
  }
  return checked({add(multiply(a.numerator, b.denominator), multiply(b.numerator, a.denominator)),
                  multiply(a.denominator, b.denominator), a.sample_period});
}

TransferFunction product(const TransferFunction& a, const TransferFunction& b) {
  require_same_period(a, b);
  return checked({multiply(a.numerator, b.numerator), multiply(a.denominator, b.denominator),
                  a.sample_period});
}

TransferFunction scaled(TransferFunction h, double factor) {
  for (double& c : h.numerator) c *= factor;
  return checked(std::move(h));
}

TransferFunction inverse(const TransferFunction& h) {
  return checked({h.denominator, h.numerator, h.sample_period});
}

TransferFunction delayed(const TransferFunction& h, int samples) {
  require(h.sample_period > 0, "a delay in samples needs a sampled system");
  require(samples >= 0, "a delay must be 0 or more samples");
  TransferFunction late = h;
  late.denominator.insert(late.denominator.end(), static_cast<std::size_t>(samples), 0.0);
  return checked(std::move(late));
}

}  // namespace reckon::bench
