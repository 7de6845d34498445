// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The thesis' own reduction (4.5, steps ii to iv), as what others are measured beside: eigenvectors
// of the Jacobian, diagonal form, the slow part of it kept. It breaks where poles coincide: a
// critically damped contact, equal lags in a row, a free body. No force path calls it.
#pragma once

#include <Eigen/Core>

#include "reckon/haptics/analysis/state_space.hpp"

namespace reckon::haptics {

/// A system in states that hang together as little as possible.
struct ModalDecomposition {
  StateSpace system;       ///< the same response; A block-diagonal, or quasi-triangular
  double condition = 1.0;  ///< of the eigenvectors; infinite where A is defective
  bool by_eigenvectors = false;
};

/// Largest condition of eigenvectors that decomposed() uses.
inline constexpr double kMostCondition = 1e8;

/// Real blocks: one number a real pole, [a b; -b a] a pair, slowest first. Where the eigenvectors
/// are worse than kMostCondition, the real Schur form instead: orthogonal, so exact to rounding.
[[nodiscard]] ModalDecomposition decomposed(const StateSpace& system);

/// What becomes of the modes that are not kept.
enum class Dropped {
  forgotten,  ///< as the thesis says
  at_rest,    ///< static gain kept, as its example (4.21) does
};

/// The `order` slowest modes by eigenvectors, whatever their condition; one more where a pair would
/// be parted. Numbers may be huge or not finite: that is what is shown.
/// @param order in [0, system.order()], else std::invalid_argument
[[nodiscard]] ModalDecomposition truncated_by_eigenvectors(const StateSpace& system, int order,
                                                           Dropped dropped);

}  // namespace reckon::haptics
