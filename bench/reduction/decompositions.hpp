// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Dense decompositions for several reductions. They are compiled only here, because they take
// longer to compile than the rest of this room.
#pragma once

#include <Eigen/Core>

namespace reckon::bench {

/// A x_i = value_i x_i, or A x_i = value_i M x_i.
struct SymmetricParts {
  Eigen::VectorXd values;   ///< n, ascending
  Eigen::MatrixXd vectors;  ///< n x n, by column; orthonormal, or M-orthonormal
};

/// Eigenvalues of a symmetric n x n matrix; reads its lower triangle. O(n^3).
[[nodiscard]] SymmetricParts symmetric_parts(const Eigen::MatrixXd& A);
/// The same for a pencil with M > 0.
[[nodiscard]] SymmetricParts symmetric_parts(const Eigen::MatrixXd& A, const Eigen::MatrixXd& M);

/// A = U diag(values) V^T.
struct SingularParts {
  Eigen::MatrixXd U;       ///< rows of A x k, k the lesser of rows and columns
  Eigen::VectorXd values;  ///< k, descending
  Eigen::MatrixXd V;       ///< columns of A x k; empty unless requested
};
enum class SingularSides : unsigned char { left, both };

/// Singular values by divide and conquer, O(n^3).
[[nodiscard]] SingularParts singular_parts(const Eigen::MatrixXd& A, SingularSides sides);

}  // namespace reckon::bench
