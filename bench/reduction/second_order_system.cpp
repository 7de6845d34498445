// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/reduction/second_order_system.hpp"

#include <Eigen/LU>
#include <Eigen/OrderingMethods>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "reckon/bench/reduction/decompositions.hpp"

namespace reckon::bench {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kSymmetry = 1e-9;   // of the largest entry
constexpr double kBorder = 1e-10;    // of the largest entry: counts as 0
constexpr double kPositive = 1e-14;  // of the largest entry: least mass
constexpr double kDense = 0.25;      // share of entries from which dense LU is faster

template <typename... Parts>
[[noreturn]] void refuse(const Parts&... parts) {
  std::ostringstream text;
  text << "second-order system: ";
  (text << ... << parts);
  throw std::invalid_argument(text.str());
}

double largest(const SparseMatrix& matrix) {
  double most = 0.0;
  for (Index k = 0; k < matrix.outerSize(); ++k) {
    for (SparseMatrix::InnerIterator entry(matrix, k); entry; ++entry) {
      most = std::max(most, std::abs(entry.value()));
    }
  }
  return most;
}

void check_finite(const SparseMatrix& matrix, const char* name) {
  for (Index k = 0; k < matrix.outerSize(); ++k) {
    for (SparseMatrix::InnerIterator entry(matrix, k); entry; ++entry) {
      if (!std::isfinite(entry.value())) {
        refuse(name, "(", entry.row(), ", ", entry.col(), ") is ", entry.value(),
               "; give a number");
      }
    }
  }
}

void check_symmetric(const SparseMatrix& matrix, const char* name) {
  const double allowed = kSymmetry * largest(matrix);
  const SparseMatrix transposed = matrix.transpose();
  const SparseMatrix difference = matrix - transposed;
  for (Index k = 0; k < difference.outerSize(); ++k) {
    for (SparseMatrix::InnerIterator entry(difference, k); entry; ++entry) {
      if (std::abs(entry.value()) > allowed) {
        refuse(name, " is not symmetric: (", entry.row(), ", ", entry.col(), ") and (", entry.col(),
               ", ", entry.row(), ") differ by ", entry.value(),
               "; give a symmetric matrix, or reduce it as a general system");
      }
    }
  }
}

struct Pivot {
  double value = 0.0;
  Index coordinate = 0;
};

// By Sylvester's law of inertia the matrix is > 0 exactly if every pivot is.
Pivot least_pivot(const SparseMatrix& matrix, double shift) {
  Eigen::SimplicialLDLT<SparseMatrix> factor;
  factor.setShift(shift);
  factor.compute(matrix);
  Pivot least;
  if (factor.info() != Eigen::Success) return least;
  Index place = 0;
  least.value = factor.vectorD().minCoeff(&place);
  if (factor.permutationPinv().size() > 0) {
    place = factor.permutationPinv().indices()[place];
  }
  least.coordinate = place;
  return least;
}

void check_definite(const SparseMatrix& matrix, const char* name, bool strictly,
                    const char* remedy) {
  const double most = largest(matrix);
  if (most == 0.0 && !strictly) return;
  // A small shift prevents a pivot of 0, at which the factorisation would stop.
  const Pivot least = least_pivot(matrix, (strictly ? -kPositive : kBorder) * most);
  if (!(least.value > 0.0)) {
    refuse(name, strictly ? " is not > 0" : " is not >= 0", ": pivot ", least.value,
           " at coordinate ", least.coordinate, "; ", remedy);
  }
}

}  // namespace

SecondOrderSystem checked(SecondOrderSystem system) {
  const Index n = system.size();
  const auto check_size = [n](const auto& matrix, const char* name, Index columns) {
    if (matrix.rows() != n || matrix.cols() != columns) {
      refuse(name, " is ", matrix.rows(), " x ", matrix.cols(), "; M has ", n, " coordinates");
    }
  };
  check_size(system.M, "M", n);
  check_size(system.D, "D", n);
  check_size(system.K, "K", n);
  if (n == 0 || system.points() == 0) refuse("no coordinate or no point; give at least one");
  check_size(system.B, "B", system.points());
  if (!system.B.allFinite()) refuse("B has an entry that is not finite; give numbers");
  if (Eigen::ColPivHouseholderQR<MatrixXd>(system.B).rank() < system.points()) {
    refuse("the ", system.points(), " columns of B depend on each other; give each point once");
  }
  const auto check_kind = [](const SparseMatrix& matrix, const char* name) {
    check_finite(matrix, name);
    check_symmetric(matrix, name);
  };
  check_kind(system.M, "M");
  check_kind(system.D, "D");
  check_kind(system.K, "K");
  check_definite(system.M, "M", true, "give every coordinate a mass");
  check_definite(system.D, "D", false, "a damper there makes energy; give dampers >= 0");
  check_definite(system.K, "K", false,
                 "a spring there pushes away (buckled); choose another operating point, or reduce "
                 "it as a general system");
  return system;
}

StaticSolver::StaticSolver(const SecondOrderSystem& system) {
  factor_.compute(system.K);
  const double least = factor_.info() == Eigen::Success ? factor_.vectorD().minCoeff() : 0.0;
  if (least > kBorder * largest(system.K)) return;

  // K phi = w^2 M phi; a rigid motion has no stiffness.
  const SymmetricParts modes = symmetric_parts(MatrixXd(system.K), MatrixXd(system.M));
  const VectorXd& squares = modes.values;
  const double border = kBorder * std::max(squares[squares.size() - 1], 0.0);
  const Index rigid = (squares.array() <= border).count();
  rigid_ = modes.vectors.leftCols(rigid);
  elastic_ = modes.vectors.rightCols(squares.size() - rigid);
  elastic_stiffness_ = squares.tail(squares.size() - rigid);
}

MatrixXd StaticSolver::solve(const MatrixXd& forces) const {
  if (!is_free()) return factor_.solve(forces);
  return elastic_ * elastic_stiffness_.cwiseInverse().asDiagonal() *
         (elastic_.transpose() * forces);
}

BodyCompliance::BodyCompliance(const SecondOrderSystem& system)
    : M_(system.M.cast<std::complex<double>>()),
      D_(system.D.cast<std::complex<double>>()),
      K_(system.K.cast<std::complex<double>>()),
      B_(system.B.cast<std::complex<double>>()) {
  const ComplexSparse pattern = K_ + D_ + M_;
  const auto n = static_cast<double>(system.size());
  is_dense_ = static_cast<double>(pattern.nonZeros()) > kDense * n * n;
  if (is_dense_) return;
  Eigen::PermutationMatrix<Eigen::Dynamic> order;
  Eigen::AMDOrdering<int>()(pattern, order);
  const auto reorder = [&](ComplexSparse& matrix) {
    const ComplexSparse moved = order.inverse() * matrix * order;
    matrix = moved;
  };
  for (ComplexSparse* matrix : {&M_, &D_, &K_}) reorder(*matrix);
  B_ = order.inverse() * B_;
  factor_.analyzePattern(ComplexSparse(K_ + D_ + M_));
}

Eigen::MatrixXcd BodyCompliance::at(double angular_frequency) {
  const std::complex<double> s(0.0, angular_frequency);
  const ComplexSparse dynamic = K_ + s * D_ + (s * s) * M_;
  if (is_dense_) {
    return B_.transpose() * Eigen::PartialPivLU<Eigen::MatrixXcd>(dynamic).solve(B_);
  }
  factor_.factorize(dynamic);
  return B_.transpose() * Eigen::MatrixXcd(factor_.solve(B_));
}

}  // namespace reckon::bench
