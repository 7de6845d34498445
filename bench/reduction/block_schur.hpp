// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Schur forms for order reduction: the slow, free and unstable part of a spectrum is split off by
// an orthogonal change of states, and Gramians. All transformations are orthogonal, so that nothing
// grows with the condition of the eigenvectors, which is infinite for coinciding poles.
#pragma once

#include <Eigen/Core>

#include "reckon/bench/linear_systems/state_space.hpp"

namespace reckon::bench {

/// Q^T A Q = [T11 T12; 0 T22], Q orthogonal, T11 `leading` x `leading`.
struct BlockSchur {
  Eigen::MatrixXd Q, T;
  Eigen::Index leading = 0;
};

/// T11 gets the eigenvalues with real part >= border, and their conjugates.
/// @throws std::runtime_error if the Schur form is not found (A not finite). Cost: O(n^3).
[[nodiscard]] BlockSchur split_spectrum(const Eigen::MatrixXd& A, double border);

/// X of A X - X B = F. @throws std::runtime_error if A and B share an eigenvalue, to rounding
[[nodiscard]] Eigen::MatrixXd solve_sylvester(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B,
                                              const Eigen::MatrixXd& F);

/// P of A P + P A^T + B B^T = 0, Q of A^T Q + Q A + C^T C = 0.
struct Gramians {
  Eigen::MatrixXd controllability, observability;
};

/// @param system continuous; all eigenvalues of A have real part < 0, else std::runtime_error.
/// Cost: one Schur form, then n^3 complex multiplications.
[[nodiscard]] Gramians gramians(const StateSpace& system);

}  // namespace reckon::bench
