// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/reduction/pressed_body.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "reckon/bench/reduction/decompositions.hpp"

namespace reckon::bench {
namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kCoupled = 1e-9;  // of the two modes' own damping: counts as 0
constexpr double kAgrees = 1e-9;   // of the force
constexpr int kCompared = 5;       // frequencies at which modes and factors are compared

// Eigenproblem of K + k B B^T in coordinates with unit mass, with D: the body held by its probes.
std::vector<Resonance> resonances_of(const MatrixXd& K, const MatrixXd& D) {
  const SymmetricParts modes = symmetric_parts(K);
  const MatrixXd& turn = modes.vectors;
  const VectorXd damping = (turn.array() * (D * turn).array()).colwise().sum();
  std::vector<Resonance> resonances;
  for (Index i = 0; i < K.rows(); ++i) {
    resonances.push_back({std::sqrt(std::max(0.0, modes.values[i])), 0.5 * damping[i]});
  }
  return resonances;
}

bool couples(const MatrixXd& D) {
  for (Index j = 0; j < D.cols(); ++j) {
    for (Index i = 0; i < j; ++i) {
      // A mode without damping has no coupling either, up to rounding of the greatest entry.
      const double own = std::max(std::sqrt(std::abs(D(i, i) * D(j, j))), 1e-4 * D(j, j));
      if (std::abs(D(i, j)) > kCoupled * own) return true;
    }
  }
  return false;
}

}  // namespace

MatrixXcd through_contact(const MatrixXcd& compliance, double stiffness) {
  const Index p = compliance.rows();
  if (p == 1) return MatrixXcd::Constant(1, 1, 1.0 / (1.0 / stiffness + compliance(0, 0)));
  return MatrixXcd(MatrixXcd::Identity(p, p) / stiffness + compliance).inverse();
}

PressedBody::PressedBody(const BodyReduction& reduction, double stiffness)
    : contact_(stiffness), by_factor_(reduction.body()) {
  if (reduction.body().size() <= BodyReduction::kMostDense) {
    find_modes(reduction.body());
  } else {
    resonances_ = resonances_of(reduction.model(reduction.most_modes()), stiffness);
  }
}

void PressedBody::find_modes(const SecondOrderSystem& body) {
  const SymmetricParts own = symmetric_parts(MatrixXd(body.K), MatrixXd(body.M));
  const MatrixXd& turn = own.vectors;
  const MatrixXd D = turn.transpose() * (body.D * turn);
  Modes modes{own.values.cwiseMax(0.0), D.diagonal().cwiseMax(0.0), turn.transpose() * body.B};
  MatrixXd held = contact_ * modes.shape * modes.shape.transpose();
  held.diagonal() += modes.stiffness;
  resonances_ = resonances_of(held, D);
  if (!couples(D) && agree(modes)) modes_ = std::move(modes);
}

// Very different masses make the slow modes inaccurate, but not the factors.
bool PressedBody::agree(const Modes& modes) {
  double fastest = 0.0;
  for (const Resonance& resonance : resonances_) fastest = std::max(fastest, resonance.omega);
  for (int i = 0; i < kCompared; ++i) {
    const double w = 1.3 * fastest * std::pow(10.0, -1.7 * i);
    const MatrixXcd right = through_contact(by_factor_.at(w), contact_);
    const MatrixXcd other = through_contact(modes.compliance(w), contact_);
    if (!((right - other).norm() <= kAgrees * contact_)) return false;
  }
  return true;
}

MatrixXcd PressedBody::Modes::compliance(double w) const {
  const Index p = shape.cols();
  MatrixXcd sum = MatrixXcd::Zero(p, p);
  for (Index i = 0; i < stiffness.size(); ++i) {
    const std::complex<double> yield =
        1.0 / std::complex<double>(stiffness[i] - w * w, w * damping[i]);
    for (Index b = 0; b < p; ++b) {
      for (Index a = 0; a < p; ++a) sum(a, b) += yield * (shape(i, a) * shape(i, b));
    }
  }
  return sum;
}

MatrixXcd PressedBody::force(double w) {
  return through_contact(modes_ ? modes_->compliance(w) : by_factor_.at(w), contact_);
}

std::vector<Resonance> resonances_of(const ModalForceModel& model, double stiffness) {
  const Index r = model.modes(), p = model.points();
  if (r == 0) return {};
  const MatrixXd W = (MatrixXd::Identity(p, p) / stiffness + model.rest).inverse();
  MatrixXd K = model.shape * W * model.shape.transpose();
  K.diagonal() += model.omega.cwiseAbs2();
  return resonances_of(K, MatrixXd(model.damping.asDiagonal()));
}

}  // namespace reckon::bench
