// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Elastic bodies as masses, dampers and springs: M x'' + D x' + K x = B f, as from finite elements
// and mass-spring meshes; and the check that such a body is passive.
#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <complex>

namespace reckon::bench {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// M x'' + D x' + K x = B f, displacement at the points u = B^T x. Force and displacement are at
/// the same points, so that f.u' is power.
struct SecondOrderSystem {
  SparseMatrix M;     ///< n x n, symmetric, > 0 [kg]
  SparseMatrix D;     ///< n x n, symmetric, >= 0 [N s/m]
  SparseMatrix K;     ///< n x n, symmetric, >= 0 [N/m]; singular for a free body
  Eigen::MatrixXd B;  ///< n x points, full column rank, place of the forces

  [[nodiscard]] Eigen::Index size() const noexcept { return M.rows(); }
  [[nodiscard]] Eigen::Index points() const noexcept { return B.cols(); }
};

/// Returns the system unchanged. A valid body is passive: its mass and springs store 1/2 x'.M x' +
/// 1/2 x.K x, and its dampers only dissipate.
/// @throws std::invalid_argument if sizes do not fit, an entry is not finite, a matrix is not
/// symmetric to 1e-9, M is not > 0, or D or K not >= 0 (to 1e-10 of its largest entry). The text
/// has the matrix, the place, the number and the remedy. Cost: three sparse Cholesky factors.
[[nodiscard]] SecondOrderSystem checked(SecondOrderSystem system);

/// Responses of the body to constant forces. A free body (K singular) has none as a whole. Its
/// elastic part responds, and the rigid motions are returned separately.
class StaticSolver {
 public:
  /// @param system checked. Cost: one sparse factor; a free body: all its modes, O(n^3).
  explicit StaticSolver(const SecondOrderSystem& system);

  [[nodiscard]] bool is_free() const noexcept { return rigid_.cols() > 0; }
  /// n x rigid motions, M-orthonormal.
  [[nodiscard]] const Eigen::MatrixXd& rigid_motions() const noexcept { return rigid_; }
  /// K^-1 times columns; for a free body the elastic part, M-orthogonal to the rigid motions.
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& forces) const;

 private:
  Eigen::SimplicialLDLT<SparseMatrix> factor_;
  Eigen::MatrixXd rigid_, elastic_;
  Eigen::VectorXd elastic_stiffness_;
};

/// Displacement per force at frequencies: C(jw) = B^T (K - w^2 M + jw D)^-1 B, points x points
/// [m/N], by LU. The LU is dense if more than a quarter of the entries is filled, else sparse with
/// an elimination order that is found once.
class BodyCompliance {
 public:
  explicit BodyCompliance(const SecondOrderSystem& system);
  /// @param angular_frequency [rad/s]; > 0 for a free body
  [[nodiscard]] Eigen::MatrixXcd at(double angular_frequency);

 private:
  using ComplexSparse = Eigen::SparseMatrix<std::complex<double>>;

  ComplexSparse M_, D_, K_;
  Eigen::MatrixXcd B_;
  bool is_dense_ = false;
  Eigen::SparseLU<ComplexSparse, Eigen::NaturalOrdering<int>> factor_;
};

}  // namespace reckon::bench
