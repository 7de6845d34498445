// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/reduction/eigen_truncation.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "reckon/bench/reduction/balanced_reduction.hpp"

namespace reckon::bench {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Slow means near 0, or near 1 for a sampled system. Eigen lists the two poles of a pair one after
// the other, and they stay together.
std::vector<Index> slowest_first(const Eigen::VectorXcd& poles, bool sampled) {
  std::vector<Index> order(static_cast<std::size_t>(poles.size()));
  std::iota(order.begin(), order.end(), Index{0});
  const auto speed = [&](Index i) { return std::abs(poles[i] - (sampled ? 1.0 : 0.0)); };
  const auto first_of_pair = [&](Index i) { return poles[i].imag() < 0.0 ? i - 1 : i; };
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) {
    return speed(first_of_pair(a)) < speed(first_of_pair(b));
  });
  return order;
}

ModalDecomposition by_eigenvectors(const StateSpace& system) {
  const Index n = system.order();
  const Eigen::EigenSolver<MatrixXd> solver(system.A);
  if (solver.info() != Eigen::Success) {
    throw std::runtime_error("eigen-truncation: no eigenvalues are found; give finite numbers");
  }
  const Eigen::VectorXcd poles = solver.eigenvalues();
  const Eigen::MatrixXcd vectors = solver.eigenvectors();
  const std::vector<Index> order = slowest_first(poles, system.is_sampled());
  MatrixXd modes(n, n), blocks = MatrixXd::Zero(n, n);
  for (Index k = 0; k < n; ++k) {
    const Index i = order[static_cast<std::size_t>(k)];
    const bool second = poles[i].imag() < 0.0;
    modes.col(k) = second ? VectorXd(-vectors.col(i).imag()) : VectorXd(vectors.col(i).real());
    blocks(k, k) = poles[i].real();
    if (second) {
      blocks(k - 1, k) = -poles[i].imag();
      blocks(k, k - 1) = poles[i].imag();
    }
  }
  ModalDecomposition result;
  const VectorXd sizes = Eigen::JacobiSVD<MatrixXd>(modes).singularValues();
  result.condition =
      sizes[n - 1] > 0.0 ? sizes[0] / sizes[n - 1] : std::numeric_limits<double>::infinity();
  result.by_eigenvectors = true;
  result.system = {blocks, modes.partialPivLu().solve(system.B), system.C * modes, system.D,
                   system.sample_period};
  return result;
}

}  // namespace

ModalDecomposition decomposed(const StateSpace& system) {
  if (system.order() == 0) return {system, 1.0, true};
  ModalDecomposition modal = by_eigenvectors(system);
  if (modal.condition <= kMostCondition) return modal;
  const Eigen::RealSchur<MatrixXd> schur(system.A);
  if (schur.info() != Eigen::Success) {
    throw std::runtime_error("decomposition: no Schur form is found; give finite numbers");
  }
  return {{schur.matrixT(), schur.matrixU().transpose() * system.B, system.C * schur.matrixU(),
           system.D, system.sample_period},
          modal.condition,
          false};
}

ModalDecomposition truncated_by_eigenvectors(const StateSpace& system, int order, Dropped dropped) {
  if (order < 0 || order > system.order()) {
    throw std::invalid_argument("eigen-truncation: order " + std::to_string(order) +
                                " of a system of " + std::to_string(system.order()) +
                                "; keep as many at most");
  }
  if (system.order() == 0) return {system, 1.0, true};
  ModalDecomposition modal = by_eigenvectors(system);
  Index kept = order;
  if (kept > 0 && kept < system.order() && modal.system.A(kept - 1, kept) != 0.0) ++kept;
  if (dropped == Dropped::at_rest) {
    modal.system = residualised(modal.system, kept);
  } else {
    const StateSpace& all = modal.system;
    modal.system = StateSpace{all.A.topLeftCorner(kept, kept), all.B.topRows(kept),
                              all.C.leftCols(kept), all.D, all.sample_period};
  }
  return modal;
}

}  // namespace reckon::bench
