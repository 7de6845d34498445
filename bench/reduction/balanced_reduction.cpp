// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/reduction/balanced_reduction.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "reckon/bench/reduction/block_schur.hpp"
#include "reckon/bench/reduction/decompositions.hpp"

namespace reckon::bench {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kFloor = 1e-10;  // of the greatest Hankel value: states below it are dropped
constexpr double kParted = 1e8;   // largest number in the transformation that separates parts
constexpr int kScaleRounds = 10;  // of row and column norms

[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument("balanced reduction: " + what);
}

// Scales states so that rows and columns of A have similar norms. Positions and velocities of fast
// systems differ by their frequency, which would cost as many digits of the Gramians.
StateSpace scaled(const StateSpace& system) {
  VectorXd units = VectorXd::Ones(system.order());
  MatrixXd A = system.A;
  for (int round = 0; round < kScaleRounds; ++round) {
    for (Index i = 0; i < A.rows(); ++i) {
      const double own = std::abs(A(i, i));
      const double row = A.row(i).lpNorm<1>() - own, column = A.col(i).lpNorm<1>() - own;
      if (!(row > 0.0) || !(column > 0.0)) continue;
      const double unit = std::exp2(std::round(0.5 * std::log2(row / column)));
      A.row(i) /= unit;
      A.col(i) *= unit;
      units[i] *= unit;
    }
  }
  return {A, units.cwiseInverse().asDiagonal() * system.B, system.C * units.asDiagonal(), system.D,
          system.sample_period};
}

// L L^T = matrix, which is >= 0 except for rounding.
MatrixXd factor(const MatrixXd& matrix) {
  const SymmetricParts parts = symmetric_parts(matrix);
  return parts.vectors * parts.values.cwiseMax(0.0).cwiseSqrt().asDiagonal();
}

// Greatest magnitude that rounding can give to a double pole at 0.
double slowest_known(const MatrixXd& A) {
  const double size = A.size() == 0 ? 0.0 : A.cwiseAbs().rowwise().sum().maxCoeff();
  return 4.0 * std::sqrt(std::numeric_limits<double>::epsilon() * size);
}

}  // namespace

StateSpace residualised(const StateSpace& system, Index kept) {
  const Index rest = system.order() - kept;
  if (kept < 0 || rest < 0) refuse("cannot keep " + std::to_string(kept) + " states");
  if (rest == 0) return system;
  // 0 = A21 x1 + A22 x2 + B2 u; sampled: x2 = the same.
  MatrixXd still = -system.A.bottomRightCorner(rest, rest);
  if (system.is_sampled()) still.diagonal().array() += 1.0;
  const Eigen::FullPivLU<MatrixXd> factor(still);
  if (!factor.isInvertible()) {
    refuse("the " + std::to_string(rest) +
           " states to be held at rest have none: they hold a free motion; keep it");
  }
  const MatrixXd by_kept = factor.solve(system.A.bottomLeftCorner(rest, kept));
  const MatrixXd by_input = factor.solve(system.B.bottomRows(rest));
  const auto A12 = system.A.topRightCorner(kept, rest);
  const auto C2 = system.C.rightCols(rest);
  return {system.A.topLeftCorner(kept, kept) + A12 * by_kept,
          system.B.topRows(kept) + A12 * by_input, system.C.leftCols(kept) + C2 * by_kept,
          system.D + C2 * by_input, system.sample_period};
}

BalancedReduction::BalancedReduction(StateSpace system, double slowest)
    : system_(checked(std::move(system))) {
  if (system_.is_sampled()) {
    refuse("the system is sampled; reduce the continuous one and sample the result");
  }
  const StateSpace even = scaled(system_);
  const Index n = even.order();
  const BlockSchur split = split_spectrum(even.A, -std::max(slowest, slowest_known(even.A)));
  const Index slow = split.leading, fast = n - slow;
  const MatrixXd B = split.Q.transpose() * even.B, C = even.C * split.Q;

  // [I X; 0 I] removes the coupling.
  MatrixXd X = MatrixXd::Zero(slow, fast);
  if (slow > 0 && fast > 0) {
    X = solve_sylvester(split.T.topLeftCorner(slow, slow), split.T.bottomRightCorner(fast, fast),
                        -split.T.topRightCorner(slow, fast));
    if (!(X.cwiseAbs().maxCoeff() <= kParted)) {
      refuse("slow and fast states are parted only by numbers of " +
             std::to_string(X.cwiseAbs().maxCoeff()) + "; give another border of what is slow");
    }
  }
  const MatrixXd none = MatrixXd::Zero(system_.outputs(), system_.inputs());
  slow_ = {split.T.topLeftCorner(slow, slow), B.topRows(slow) - X * B.bottomRows(fast),
           C.leftCols(slow), none, 0.0};
  balance({split.T.bottomRightCorner(fast, fast), B.bottomRows(fast),
           C.leftCols(slow) * X + C.rightCols(fast), system_.D, 0.0});
}

// By square roots: P = L L^T, Q = R R^T, R^T L = U S V^T.
void BalancedReduction::balance(const StateSpace& stable) {
  const Index n = stable.order();
  balanced_ = stable;
  static_gain_ = stable.D;
  hankel_.resize(n);
  if (n == 0) return;
  static_gain_ -= stable.C * stable.A.partialPivLu().solve(stable.B);
  const Gramians both = gramians(stable);
  const MatrixXd L = factor(both.controllability), R = factor(both.observability);
  const SingularParts parts = singular_parts(R.transpose() * L, SingularSides::both);
  hankel_ = parts.values;
  const Index known = hankel_[0] > 0.0 ? (hankel_.array() > kFloor * hankel_[0]).count() : 0;
  lost_ = static_cast<double>(n - known) * kFloor * hankel_[0];
  const VectorXd roots = hankel_.head(known).cwiseSqrt().cwiseInverse();
  const MatrixXd into = L * parts.V.leftCols(known) * roots.asDiagonal();
  const MatrixXd from = roots.asDiagonal() * parts.U.leftCols(known).transpose() * R.transpose();
  balanced_ = {from * stable.A * into, from * stable.B, stable.C * into, stable.D, 0.0};
}

int BalancedReduction::least_order() const noexcept { return static_cast<int>(slow_.order()); }

int BalancedReduction::most_order() const noexcept {
  return static_cast<int>(slow_.order() + balanced_.order());
}

void BalancedReduction::check_order(int order) const {
  if (order >= least_order() && order <= most_order()) return;
  refuse("order " + std::to_string(order) + "; this system gives " + std::to_string(least_order()) +
         " to " + std::to_string(most_order()));
}

StateSpace BalancedReduction::model(int order) const {
  check_order(order);
  StateSpace fast = residualised(balanced_, order - least_order());
  // The states below rounding still count for constant forces.
  MatrixXd gain = fast.D;
  if (fast.order() > 0) gain -= fast.C * fast.A.partialPivLu().solve(fast.B);
  fast.D += static_gain_ - gain;
  return parallel(slow_, fast);
}

StateSpace BalancedReduction::truncated(int order) const {
  check_order(order);
  const Index kept = order - least_order();
  return parallel(slow_, {balanced_.A.topLeftCorner(kept, kept), balanced_.B.topRows(kept),
                          balanced_.C.leftCols(kept), balanced_.D, 0.0});
}

double BalancedReduction::bound(int order) const {
  check_order(order);
  const Index kept = order - least_order();
  return 2.0 * (hankel_.segment(kept, balanced_.order() - kept).sum() + lost_);
}

}  // namespace reckon::bench
