// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/linear_systems/border_poles.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>

namespace reckon::bench {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

constexpr double kOnBorder = 1e-10;
constexpr double kOnePole = 1e-9;
constexpr double kDefective = 1e-7;

// s = scale (z - 1)/(z + 1) maps the axis to the circle; the scale moves the poles to the middle.
StateSpace bilinear(const StateSpace& s, double scale) {
  const Index n = s.order();
  const Eigen::PartialPivLU<MatrixXd> lu(scale * MatrixXd::Identity(n, n) - s.A);
  const MatrixXd M = lu.solve(MatrixXd::Identity(n, n));
  return {M * (scale * MatrixXd::Identity(n, n) + s.A), std::sqrt(2 * scale) * M * s.B,
          std::sqrt(2 * scale) * s.C * M, s.D + s.C * M * s.B, 1.0};
}

// Geometric mean of the poles' magnitudes without those near 0. Positive and no eigenvalue of A.
double middle_scale(const Eigen::VectorXcd& all) {
  const double greatest = all.size() == 0 ? 0.0 : all.cwiseAbs().maxCoeff();
  if (greatest == 0) return 1.0;
  double sum = 0.0, worst = 0.0;
  int count = 0;
  for (const Complex p : all) {
    if (std::abs(p) < 1e-9 * greatest) continue;
    sum += std::log(std::abs(p));
    ++count;
  }
  double scale = std::exp(sum / count);
  for (const Complex p : all)
    worst = std::max(worst, std::abs(p - scale) < 0.01 * scale ? 1.0 : 0.0);
  return worst > 0 ? 1.1 * scale : scale;
}

struct Group {
  Complex place = 0;
  Index count = 0;
};

// Poles of the given system, sorted by their place. This is decided before any mapping, which would
// move slow and fast poles close to the border.
struct Sorted {
  std::vector<Group> border;  // on the circle
  std::optional<double> beyond;
};

Sorted sorted_poles(const Eigen::VectorXcd& all, double sample_period, double scale) {
  Sorted sorted;
  const double greatest = all.size() == 0 ? 0.0 : all.cwiseAbs().maxCoeff();
  for (const Complex p : all) {
    const bool sampled = sample_period > 0;
    const double inside = sampled ? 1.0 - std::abs(p) : -p.real();
    const double rounding = sampled ? kOnBorder : kOnBorder * std::abs(p) + 1e-12 * greatest;
    if (inside < -rounding) sorted.beyond = sampled ? std::arg(p) / sample_period : p.imag();
    if (std::abs(inside) > rounding) continue;
    const Complex mapped = sampled ? p : (scale + p) / (scale - p);
    const Complex place = mapped / std::abs(mapped);
    const auto near = std::find_if(sorted.border.begin(), sorted.border.end(), [&](const Group& g) {
      return std::abs(g.place - place) <= kOnePole;
    });
    Group& g = near != sorted.border.end() ? *near : sorted.border.emplace_back();
    if (g.count++ == 0) g.place = place;
  }
  return sorted;
}

// Removes a semisimple pole from the system. Its projector V W^H gives the residue. Its eigenvalue
// in A becomes 0, where it is no longer reached.
BorderPole split_off(CircleSystem& s, const Group& group) {
  BorderPole pole{std::arg(group.place), {}, true};
  MatrixXcd shifted = s.A;
  shifted.diagonal().array() -= group.place;
  const Eigen::JacobiSVD<MatrixXcd> svd(shifted, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const MatrixXcd V = svd.matrixV().rightCols(group.count);
  const MatrixXcd U = svd.matrixU().rightCols(group.count);
  const Eigen::FullPivLU<MatrixXcd> pairing(U.adjoint() * V);
  const double null_size = svd.singularValues()(s.A.rows() - group.count);
  pole.simple = null_size <= kDefective * std::max(1.0, svd.singularValues()(0)) &&
                pairing.rank() == group.count && pairing.rcond() > kDefective;
  if (!pole.simple) return pole;

  const MatrixXcd projector = V * pairing.solve(U.adjoint());
  pole.residue = std::conj(group.place) * s.C * projector * s.B;
  s.B -= projector * s.B;
  s.A -= group.place * projector;
  s.D -= 0.5 * pole.residue;
  return pole;
}

// Makes A triangular: then a response costs O(n^2) and the poles are the diagonal.
void make_triangular(CircleSystem& s) {
  if (s.A.rows() == 0) return;
  const Eigen::ComplexSchur<MatrixXcd> schur(s.A);
  if (schur.info() != Eigen::Success) {
    throw std::runtime_error("positive real: no Schur form of A was found; scale the model");
  }
  s.A = schur.matrixT();
  s.B = schur.matrixU().adjoint() * s.B;
  s.C = s.C * schur.matrixU();
}

}  // namespace

double CircleSystem::frequency_of(double angle) const {
  if (scale == 0) return angle / sample_period;
  if (std::abs(angle) >= std::numbers::pi) return std::numeric_limits<double>::infinity();
  return scale * std::tan(0.5 * angle);
}

MatrixXcd CircleSystem::response(double angle) const {
  if (A.rows() == 0) return D;
  MatrixXcd resolvent = -A;
  resolvent.diagonal().array() += std::polar(1.0, angle);
  return C * resolvent.triangularView<Eigen::Upper>().solve(B) + D;
}

CircleSystem on_unit_circle(const StateSpace& system) {
  const StateSpace given = checked(system);
  if (given.inputs() != given.outputs() || given.inputs() == 0) {
    throw std::invalid_argument(
        "passivity is a property of ports: a system needs as many outputs as inputs");
  }
  CircleSystem s;
  s.sample_period = given.sample_period;
  const Eigen::VectorXcd all = poles(given);
  if (!given.is_sampled()) s.scale = middle_scale(all);
  const StateSpace sampled = given.is_sampled() ? given : bilinear(given, s.scale);
  s.A = sampled.A;
  s.B = sampled.B;
  s.C = sampled.C;
  s.D = sampled.D;

  const Sorted sorted = sorted_poles(all, given.sample_period, s.scale);
  s.beyond = sorted.beyond;
  for (const Group& group : sorted.border) s.border.push_back(split_off(s, group));
  make_triangular(s);
  return s;
}

}  // namespace reckon::bench
