// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/reduction/congruence_reduction.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "reckon/bench/reduction/decompositions.hpp"

namespace reckon::bench {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kDependent = 1e-10;  // of a vector: a smaller remainder is rounding
constexpr Index kMaster = 48;         // Krylov vectors of the body from which snapshots are taken
constexpr int kFrequencies = 40;      // of snapshots
constexpr double kSlower = 0.3;       // lowest frequency over the slowest mode's

// Makes the columns M-orthonormal to the basis and to each other and appends them, up to `most` in
// total. It runs twice, because once leaves a remainder by rounding. Returns the number of new
// columns.
Index append(const SparseMatrix& M, const MatrixXd& columns, Index most, MatrixXd& basis) {
  const Index before = basis.cols();
  for (Index i = 0; i < columns.cols() && basis.cols() < most; ++i) {
    VectorXd column = columns.col(i);
    const double whole = std::sqrt(column.dot(M * column));
    for (int pass = 0; pass < 2; ++pass) column -= basis * (basis.transpose() * (M * column));
    const double left = std::sqrt(column.dot(M * column));
    if (!(left > kDependent * whole)) continue;
    basis.conservativeResize(Eigen::NoChange, basis.cols() + 1);
    basis.rightCols(1) = column / left;
  }
  return basis.cols() - before;
}

MatrixXd krylov_basis(const SecondOrderSystem& body, const StaticSolver& solver, Index most) {
  MatrixXd basis(body.size(), 0);
  append(body.M, solver.rigid_motions(), most, basis);
  MatrixXd next = solver.solve(body.B);
  for (Index added = append(body.M, next, most, basis); added > 0;) {
    next = solver.solve(body.M * basis.rightCols(added));
    added = append(body.M, next, most, basis);
  }
  return basis;
}

// Singular vectors of the snapshots, greatest first.
MatrixXd main_parts(const MatrixXd& snapshots) {
  const SingularParts parts = singular_parts(snapshots, SingularSides::left);
  const VectorXd& sizes = parts.values;
  const Index count = (sizes.array() > kDependent * sizes[0]).count();
  return parts.U.leftCols(count);
}

// Frequencies from slow ones to the master's fastest mode, in steps of equal ratio [rad/s].
VectorXd snapshot_frequencies(const VectorXd& omega) {
  const double slowest = kSlower * omega.minCoeff(), fastest = omega.maxCoeff();
  return VectorXd::LinSpaced(kFrequencies, std::log(slowest), std::log(fastest)).array().exp();
}

// Snapshots of a master with many Krylov vectors, from its modes: cheap at any frequency. The
// dampers' coupling of modes is left out: the basis suits the body a little less, and the result
// stays correct.
MatrixXd snapshot_basis(const SecondOrderSystem& body, const StaticSolver& solver, Index most) {
  const MatrixXd master = krylov_basis(body, solver, std::min(kMaster, body.size()));
  const Index rigid = solver.rigid_motions().cols(), elastic = master.cols() - rigid;
  MatrixXd basis = master.leftCols(rigid);
  if (elastic <= 0) return basis;
  const MatrixXd V = master.rightCols(elastic);
  const SymmetricParts modes = symmetric_parts(V.transpose() * (body.K * V));
  const MatrixXd shapes = V * modes.vectors;
  const VectorXd& squares = modes.values;
  const VectorXd damping = (shapes.transpose() * (body.D * shapes)).diagonal();
  const MatrixXd onto = shapes.transpose() * body.B;

  const VectorXd frequencies = snapshot_frequencies(squares.cwiseSqrt());
  const Index points = body.points();
  MatrixXd snapshots(elastic, 2 * points * frequencies.size());
  for (Index k = 0; k < frequencies.size(); ++k) {
    const double w = frequencies[k];
    const Eigen::ArrayXd stiffness = squares.array() - w * w, drag = w * damping.array();
    const Eigen::ArrayXd scale = (stiffness.square() + drag.square()).inverse();
    const Index at = 2 * points * k;
    snapshots.middleCols(at, points) = (stiffness * scale).matrix().asDiagonal() * onto;
    snapshots.middleCols(at + points, points) = (drag * scale).matrix().asDiagonal() * onto;
  }
  append(body.M, shapes * main_parts(snapshots), most, basis);
  return basis;
}

MatrixXd mode_basis(const SecondOrderSystem& body, Index most) {
  const SymmetricParts modes = symmetric_parts(MatrixXd(body.K), MatrixXd(body.M));
  return modes.vectors.leftCols(std::min(most, body.size()));
}

[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument("order reduction of a body: " + what);
}

}  // namespace

BodyReduction::BodyReduction(SecondOrderSystem body, Basis basis)
    : body_(checked(std::move(body))), kind_(basis), solver_(body_) {
  check_size();
  const Index most = std::min<Index>(ModalForceModel::kMostModes, body_.size());
  switch (basis) {
    case Basis::krylov:
      basis_ = krylov_basis(body_, solver_, most);
      break;
    case Basis::snapshots:
      basis_ = snapshot_basis(body_, solver_, most);
      break;
    case Basis::modes:
      basis_ = mode_basis(body_, most);
      break;
  }
  project();
}

BodyReduction::BodyReduction(SecondOrderSystem body, const MatrixXd& snapshots)
    : body_(checked(std::move(body))),
      kind_(Basis::snapshots),
      solver_(body_),
      basis_(body_.size(), 0) {
  check_size();
  if (snapshots.rows() != body_.size() || snapshots.cols() == 0 || !snapshots.allFinite()) {
    refuse(std::to_string(snapshots.cols()) + " snapshots of " + std::to_string(snapshots.rows()) +
           " coordinates for a body of " + std::to_string(body_.size()) +
           "; give columns of finite coordinates");
  }
  const Index most = std::min<Index>(ModalForceModel::kMostModes, body_.size());
  append(body_.M, solver_.rigid_motions(), most, basis_);
  append(body_.M, main_parts(snapshots), most, basis_);
  project();
}

void BodyReduction::check_size() const {
  if (body_.points() > ModalForceModel::kMostPoints) {
    refuse(std::to_string(body_.points()) + " points; a model has " +
           std::to_string(ModalForceModel::kMostPoints) + " at most, choose among them");
  }
  if ((kind_ == Basis::modes || solver_.is_free()) && body_.size() > kMostDense) {
    refuse(std::to_string(body_.size()) + " coordinates whose modes are asked for, " +
           std::to_string(kMostDense) + " at most; hold the body somewhere and use Krylov vectors");
  }
}

void BodyReduction::project() {
  M_ = basis_.transpose() * (body_.M * basis_);
  D_ = basis_.transpose() * (body_.D * basis_);
  K_ = basis_.transpose() * (body_.K * basis_);
  B_ = basis_.transpose() * body_.B;
  static_compliance_ = body_.B.transpose() * solver_.solve(body_.B);
}

int BodyReduction::least_modes() const noexcept {
  return static_cast<int>(solver_.rigid_motions().cols());
}

int BodyReduction::most_modes() const noexcept { return static_cast<int>(basis_.cols()); }

ModalForceModel BodyReduction::model(int modes) const {
  if (modes < least_modes() || modes > most_modes()) {
    refuse(std::to_string(modes) + " modes; this basis gives " + std::to_string(least_modes()) +
           " to " + std::to_string(most_modes()));
  }
  const Index r = modes, rigid = least_modes(), points = body_.points();
  ModalForceModel model;
  model.omega.setZero(r);
  model.damping.setZero(r);
  model.shape.setZero(r, points);
  MatrixXd in_modes = MatrixXd::Zero(points, points);
  if (r > 0) {
    const SymmetricParts pencil = symmetric_parts(K_.topLeftCorner(r, r), M_.topLeftCorner(r, r));
    const MatrixXd& turn = pencil.vectors;
    model.shape = turn.transpose() * B_.topRows(r);
    model.damping = (turn.transpose() * D_.topLeftCorner(r, r) * turn).diagonal().cwiseMax(0.0);
    model.omega = pencil.values.cwiseMax(0.0).cwiseSqrt();
    model.omega.head(rigid).setZero();
    const MatrixXd elastic = model.shape.bottomRows(r - rigid);
    const VectorXd inverse = model.omega.tail(r - rigid).cwiseAbs2().cwiseInverse();
    in_modes = elastic.transpose() * inverse.asDiagonal() * elastic;
  }
  // In theory >= 0. If rounding makes a zero negative, the negative part is dropped.
  const MatrixXd rest = static_compliance_ - in_modes;
  const SymmetricParts parts = symmetric_parts(0.5 * (rest + rest.transpose()));
  model.rest = parts.vectors * parts.values.cwiseMax(0.0).asDiagonal() * parts.vectors.transpose();
  return model;
}

}  // namespace reckon::bench
