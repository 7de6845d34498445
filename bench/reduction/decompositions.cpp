// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/reduction/decompositions.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

namespace reckon::bench {

using Eigen::MatrixXd;

SymmetricParts symmetric_parts(const MatrixXd& A) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> parts(A);
  return {parts.eigenvalues(), parts.eigenvectors()};
}

SymmetricParts symmetric_parts(const MatrixXd& A, const MatrixXd& M) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> parts(A, M);
  return {parts.eigenvalues(), parts.eigenvectors()};
}

SingularParts singular_parts(const MatrixXd& A, SingularSides sides) {
  const bool right = sides == SingularSides::both;
  const Eigen::BDCSVD<MatrixXd> parts(A, Eigen::ComputeThinU | (right ? Eigen::ComputeThinV : 0));
  return {parts.matrixU(), parts.singularValues(), right ? parts.matrixV() : MatrixXd()};
}

}  // namespace reckon::bench
