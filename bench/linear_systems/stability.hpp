// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Criterion 1 of the thesis: no roots beyond the border, only simple ones on it. Off-line code.
#pragma once

#include <Eigen/Core>

#include "reckon/bench/linear_systems/state_space.hpp"

namespace reckon::bench {

enum class Stability {
  asymptotic,  ///< all roots inside
  marginal,    ///< some on the border, all of them simple
  unstable,    ///< one beyond the border, or a multiple one on it
};

struct StabilityReport {
  Stability verdict = Stability::unstable;
  /// Least distance of a root from the border, > 0 inside: 1 - |z|, or -Re s [1/s]. Infinite
  /// without roots. Roots that rounding does not distinguish count as one, at their mean.
  double margin = 0.0;
  bool multiple_on_border = false;
};

/// Judges the roots of a characteristic equation. Roots within 3e-6 of each other are one multiple
/// root. A mean within 1e-9 of the border lies on it; in continuous time the 1e-9 is relative to
/// the greatest |s|. A double root is only known to 1e-8. @param sample_period [s]; 0: continuous
[[nodiscard]] StabilityReport judge_roots(const Eigen::VectorXcd& roots, double sample_period);

/// Judges the eigenvalues of A. If a multiple eigenvalue on the border has a full set of
/// eigenvectors (two free masses side by side), no state grows. This is marginal, although the
/// characteristic equation has a multiple root. @throws std::invalid_argument, std::runtime_error
/// from poles() and checked()
[[nodiscard]] StabilityReport judge_stability(const StateSpace& system);

/// Greatest |z| of a sampled system's poles, the growth or decay factor of a state per sample. 0
/// without states. @throws std::invalid_argument for a continuous system
[[nodiscard]] double spectral_radius(const StateSpace& system);

}  // namespace reckon::bench
