// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Criterion 3 of the thesis: whether a linear model with one or several ports is passive. Exact:
// the least value over all frequencies comes from eigenvalues, not from a grid. Off-line code.
#pragma once

#include <string>

#include "reckon/bench/linear_systems/state_space.hpp"
#include "reckon/bench/linear_systems/transfer_function.hpp"

namespace reckon::bench {

/// Reason why a model is not positive real.
enum class ActiveBecause {
  nothing,             ///< it is positive real
  pole_beyond_border,  ///< it is unstable by itself
  multiple_pole,       ///< a multiple pole on the border, with fewer eigenvectors
  residue,             ///< a pole on the border whose residue is not Hermitian and >= 0
  negative_real_part,  ///< it supplies energy at some frequency
};

struct PositiveRealReport {
  ActiveBecause because = ActiveBecause::nothing;
  /// Least eigenvalue of (P + P^H)/2 over the border without the poles on it; in P's unit.
  /// -infinity if the model is unstable or has an invalid pole on the border.
  double least = 0.0;
  /// Frequency of the least value, or of the invalid pole [rad/s] >= 0. Infinite if the least value
  /// is the high-frequency limit of a continuous system.
  double angular_frequency = 0.0;

  [[nodiscard]] bool is_positive_real() const noexcept { return because == ActiveBecause::nothing; }
};

/// (3.2) with the conjugate transpose that it lacks: P + P^H >= 0 on the border, no poles beyond
/// it, simple ones on it. The least value is found by level sets: the eigenvalues of a Hamiltonian
/// matrix are the frequencies where (P + P^H)/2 has a given eigenvalue, so that no dip is too
/// narrow. Converges quadratically to rounding. O(n^3) a round, mostly 1 or 2 rounds.
///
/// A value down to -1e-11 of the model's own size counts as 0. Models with poles on the border must
/// be minimal, because a cancelled multiple pole there would count as one.
/// @throws std::invalid_argument if an entry is not finite or the numbers of inputs and outputs
/// differ
[[nodiscard]] PositiveRealReport judge_positive_real(const StateSpace& model);

/// The same for one port. If the numerator has a degree one higher, the inverse is judged (1/P is
/// positive real where P is), and its least value is reported.
[[nodiscard]] PositiveRealReport judge_positive_real(const TransferFunction& model);

/// One sentence: "negative real part, -0.05 at 12.3 rad/s".
[[nodiscard]] std::string describe(const PositiveRealReport& report);

}  // namespace reckon::bench
