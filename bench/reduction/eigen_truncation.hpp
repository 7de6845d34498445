// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The reduction of the thesis (4.5, steps ii to iv), as a reference for the others: eigenvectors of
// the Jacobian, diagonal form, of which the slow part is kept. It fails for coinciding poles: a
// critically damped contact, equal lags in series, a free body. No force path calls it.
#pragma once

#include <Eigen/Core>

#include "reckon/bench/linear_systems/state_space.hpp"

namespace reckon::bench {

/// A system in states with the least coupling.
struct ModalDecomposition {
  StateSpace system;       ///< the same response; A block-diagonal, or quasi-triangular
  double condition = 1.0;  ///< of the eigenvectors; infinite for a defective A
  bool by_eigenvectors = false;
};

/// Greatest condition of the eigenvectors at which decomposed() uses them.
inline constexpr double kMostCondition = 1e8;

/// Real blocks: one number for a real pole, [a b; -b a] for a pair, slowest first. If the condition
/// of the eigenvectors exceeds kMostCondition, the real Schur form is used instead, which is
/// orthogonal and so exact to rounding.
[[nodiscard]] ModalDecomposition decomposed(const StateSpace& system);

/// Treatment of the modes that are not kept.
enum class Dropped {
  forgotten,  ///< left out, as in the thesis
  at_rest,    ///< static gain kept, as in its example (4.21)
};

/// The `order` slowest modes by eigenvectors, for any condition of these; one more if a pair would
/// be split. Numbers may be huge or not finite, which is the purpose of the comparison.
/// @param order in [0, system.order()], else std::invalid_argument
[[nodiscard]] ModalDecomposition truncated_by_eigenvectors(const StateSpace& system, int order,
                                                           Dropped dropped);

}  // namespace reckon::bench
