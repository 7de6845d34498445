// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Dense decompositions that several reductions take: compiled once, for they take longer to compile
// than all the rest of this room.
#pragma once

#include <Eigen/Core>

namespace reckon::haptics {

/// A x_i = value_i x_i, or A x_i = value_i M x_i.
struct SymmetricParts {
  Eigen::VectorXd values;   ///< n, rising
  Eigen::MatrixXd vectors;  ///< n x n, by column; orthonormal, or with respect to M
};

/// Of a symmetric n x n matrix, of which the lower triangle is read. O(n^3).
[[nodiscard]] SymmetricParts symmetric_parts(const Eigen::MatrixXd& A);
/// Of a pencil of which M is > 0.
[[nodiscard]] SymmetricParts symmetric_parts(const Eigen::MatrixXd& A, const Eigen::MatrixXd& M);

/// A = U diag(values) V^T.
struct SingularParts {
  Eigen::MatrixXd U;       ///< rows of A x k, k the lesser of rows and columns
  Eigen::VectorXd values;  ///< k, falling
  Eigen::MatrixXd V;       ///< columns of A x k; empty where it was not asked for
};
enum class SingularSides : unsigned char { left, both };

/// By divide and conquer, O(n^3).
[[nodiscard]] SingularParts singular_parts(const Eigen::MatrixXd& A, SingularSides sides);

}  // namespace reckon::haptics
