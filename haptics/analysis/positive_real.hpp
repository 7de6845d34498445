// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Criterion 3 of the thesis: whether a linear model, of one port or several, is passive. Exact: the
// least value over all frequencies comes from eigenvalues, not from a grid. Off-line code.
#pragma once

#include <string>

#include "reckon/haptics/analysis/state_space.hpp"
#include "reckon/haptics/analysis/transfer_function.hpp"

namespace reckon::haptics {

/// Why a model is not positive real.
enum class ActiveBecause {
  nothing,             ///< it is positive real
  pole_beyond_border,  ///< it is unstable by itself
  multiple_pole,       ///< a multiple pole on the border, with fewer eigenvectors
  residue,             ///< a pole on the border whose residue is not Hermitian and >= 0
  negative_real_part,  ///< at some frequency it gives energy
};

struct PositiveRealReport {
  ActiveBecause because = ActiveBecause::nothing;
  /// Least eigenvalue of (P + P^H)/2 over the border, poles on it left out; in P's unit.
  /// -infinity where the model is unstable or has a bad pole on the border.
  double least = 0.0;
  /// Where: of the least value, or of the bad pole [rad/s] >= 0. Infinite where the least value is
  /// that of a continuous system's limit.
  double angular_frequency = 0.0;

  [[nodiscard]] bool is_positive_real() const noexcept { return because == ActiveBecause::nothing; }
};

/// (3.2) with the conjugate transpose that it lacks: P + P^H >= 0 on the border, no poles beyond
/// it, simple ones on it. Least value by level sets: the eigenvalues of a Hamiltonian matrix are
/// the frequencies where (P + P^H)/2 has a given eigenvalue, so that no dip is too narrow;
/// converges quadratically to rounding. O(n^3) a round, some 3 to 5 rounds.
///
/// A value down to -1e-11 of the model's own size counts as 0. Models must be minimal where they
/// have poles on the border: a cancelled multiple pole there is taken for one.
/// @throws std::invalid_argument where an entry is not finite or inputs and outputs differ in
/// number
[[nodiscard]] PositiveRealReport judge_positive_real(const StateSpace& model);

/// The same of one port. One degree more in the numerator is judged by its inverse (1/P is positive
/// real where P is), whose least value is then reported.
[[nodiscard]] PositiveRealReport judge_positive_real(const TransferFunction& model);

/// One sentence: "negative real part, -0.05 at 12.3 rad/s".
[[nodiscard]] std::string describe(const PositiveRealReport& report);

}  // namespace reckon::haptics
