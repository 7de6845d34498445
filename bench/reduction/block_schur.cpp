// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/reduction/block_schur.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Jacobi>
#include <Eigen/QR>
#include <cmath>
#include <complex>
#include <stdexcept>
#include <vector>

namespace reckon::bench {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;

constexpr double kCoupled = 1e-9;  // of |A|: greatest entry allowed below the blocks

// A = U T U^H, T upper triangular.
struct ComplexSchurForm {
  MatrixXcd U, T;
};

// The real form first: its blocks of two are easily made complex, which is faster in total.
ComplexSchurForm schur_form(const MatrixXd& A) {
  if (A.rows() == 0) return {};
  const Eigen::RealSchur<MatrixXd> real(A);
  Eigen::ComplexSchur<MatrixXcd> schur(A.rows());
  if (real.info() == Eigen::Success) {
    schur.computeFromHessenberg(real.matrixT().cast<Complex>(), real.matrixU().cast<Complex>(),
                                true);
    if (schur.info() == Eigen::Success) return {schur.matrixU(), schur.matrixT()};
  }
  throw std::runtime_error("order reduction: no Schur form of the " + std::to_string(A.rows()) +
                           " x " + std::to_string(A.cols()) +
                           " system is found; see whether its numbers are finite");
}

// Swaps the eigenvalues k and k + 1.
void swap_neighbours(ComplexSchurForm& form, Index k) {
  const Complex first = form.T(k, k), second = form.T(k + 1, k + 1);
  Eigen::JacobiRotation<Complex> turn;
  turn.makeGivens(form.T(k, k + 1), second - first);
  form.T.applyOnTheLeft(k, k + 1, turn.adjoint());
  form.T.applyOnTheRight(k, k + 1, turn);
  form.U.applyOnTheRight(k, k + 1, turn);
  form.T(k, k) = second;
  form.T(k + 1, k + 1) = first;
  form.T(k + 1, k) = 0.0;
}

// Selects both eigenvalues of a pair that rounding splits at the border.
std::vector<bool> chosen(const VectorXcd& values, double border) {
  std::vector<bool> taken(static_cast<std::size_t>(values.size()), false);
  for (Index i = 0; i < values.size(); ++i) {
    if (values[i].real() < border) continue;
    taken[static_cast<std::size_t>(i)] = true;
    if (values[i].imag() == 0.0) continue;
    Index partner = 0;
    (values.array() - std::conj(values[i])).abs().minCoeff(&partner);
    taken[static_cast<std::size_t>(partner)] = true;
  }
  return taken;
}

Index move_to_front(ComplexSchurForm& form, const std::vector<bool>& taken) {
  Index leading = 0;
  for (Index i = 0; i < form.T.rows(); ++i) {
    if (!taken[static_cast<std::size_t>(i)]) continue;
    for (Index k = i; k > leading; --k) swap_neighbours(form, k - 1);
    ++leading;
  }
  return leading;
}

// Solves with T + shift I where possible.
void solve_shifted(const MatrixXcd& T, Complex shift, bool adjoint, VectorXcd& side) {
  MatrixXcd shifted = T;
  shifted.diagonal().array() += shift;
  const double least = shifted.diagonal().cwiseAbs().minCoeff();
  if (!(least > 1e-14 * (T.diagonal().cwiseAbs().maxCoeff() + std::abs(shift)))) {
    throw std::runtime_error(
        "order reduction: two parts of the system share a pole to rounding; do not part them");
  }
  const auto triangle = shifted.triangularView<Eigen::Upper>();
  if (adjoint) {
    triangle.adjoint().solveInPlace(side);
  } else {
    triangle.solveInPlace(side);
  }
}

}  // namespace

BlockSchur split_spectrum(const MatrixXd& A, double border) {
  const Index n = A.rows();
  BlockSchur split{MatrixXd::Identity(n, n), A, 0};
  ComplexSchurForm form = schur_form(A);
  if (n == 0) return split;
  split.leading = move_to_front(form, chosen(form.T.diagonal(), border));
  if (split.leading == 0 || split.leading == n) return split;

  // The space of conjugate eigenvalues has a real basis, because its projector is real.
  const MatrixXcd front = form.U.leftCols(split.leading);
  const MatrixXd projector = (front * front.adjoint()).real();
  split.Q = Eigen::ColPivHouseholderQR<MatrixXd>(projector).householderQ();
  split.T = split.Q.transpose() * A * split.Q;
  auto below = split.T.bottomLeftCorner(n - split.leading, split.leading);
  if (!(below.norm() <= kCoupled * A.norm())) {
    throw std::runtime_error("order reduction: slow and fast poles cannot be parted, " +
                             std::to_string(below.norm()) +
                             " is left between them; give another border");
  }
  below.setZero();
  return split;
}

MatrixXd solve_sylvester(const MatrixXd& A, const MatrixXd& B, const MatrixXd& F) {
  const ComplexSchurForm a = schur_form(A), b = schur_form(B);
  MatrixXcd Y = a.U.adjoint() * F.cast<Complex>() * b.U;
  for (Index k = 0; k < Y.cols(); ++k) {
    VectorXcd side = Y.col(k) + Y.leftCols(k) * b.T.col(k).head(k);
    solve_shifted(a.T, -b.T(k, k), false, side);
    Y.col(k) = side;
  }
  return (a.U * Y * b.U.adjoint()).real();
}

Gramians gramians(const StateSpace& system) {
  const Index n = system.order();
  if (n == 0) return {MatrixXd(0, 0), MatrixXd(0, 0)};
  const ComplexSchurForm form = schur_form(system.A);
  const MatrixXcd& T = form.T;
  if (T.diagonal().real().maxCoeff() >= 0.0) {
    throw std::runtime_error("order reduction: a pole at real part " +
                             std::to_string(T.diagonal().real().maxCoeff()) +
                             " has no Gramian; set unstable and free parts aside");
  }
  const MatrixXcd onto = form.U.adjoint() * system.B, from = system.C * form.U;
  MatrixXcd P = -onto * onto.adjoint(), Q = -from.adjoint() * from;
  for (Index k = n - 1; k >= 0; --k) {
    const Index after = n - 1 - k;
    VectorXcd side = P.col(k) - P.rightCols(after) * T.row(k).tail(after).adjoint();
    solve_shifted(T, std::conj(T(k, k)), false, side);
    P.col(k) = side;
  }
  for (Index k = 0; k < n; ++k) {
    VectorXcd side = Q.col(k) - Q.leftCols(k) * T.col(k).head(k);
    // (T^H + t I) = (T + conj(t) I)^H
    solve_shifted(T, std::conj(T(k, k)), true, side);
    Q.col(k) = side;
  }
  Gramians both{(form.U * P * form.U.adjoint()).real(), (form.U * Q * form.U.adjoint()).real()};
  both.controllability = 0.5 * (both.controllability + both.controllability.transpose()).eval();
  both.observability = 0.5 * (both.observability + both.observability.transpose()).eval();
  return both;
}

}  // namespace reckon::bench
