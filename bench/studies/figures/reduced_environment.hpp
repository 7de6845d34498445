// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Thesis Figs 4.8 to 4.13: two users with the complex environment of (4.21), with the simple one
// that replaces its pole alpha by the static gain, and the error of this replacement.
#pragma once

#include "reckon/bench/studies/figures/figure.hpp"

namespace reckon::bench {

/// (4.21) between two users, K = (1 - alpha)/2, so that the static gain matches the thesis'
/// velocity of 1.25 = 1/(b + K/(1 - alpha)).
struct ReductionScene {
  double alpha = 0.6;
  double wall_damping = 0.0;  ///< b_e in addition to (4.21), which has none [N s/m]
  double other_push = 1.0;    ///< of the second user [N]
  double duration = 15.0;     ///< [s]
};

/// Greatest differences between simple and complex environment, of the first user.
struct ReductionErrors {
  double force = 0, velocity = 0;  ///< [N], [m/s]
};
[[nodiscard]] ReductionErrors reduction_errors(const ReductionScene& scene);

[[nodiscard]] Figure figure_complex_force();     ///< 4.8
[[nodiscard]] Figure figure_simple_force();      ///< 4.9
[[nodiscard]] Figure figure_force_error();       ///< 4.10
[[nodiscard]] Figure figure_complex_velocity();  ///< 4.11
[[nodiscard]] Figure figure_simple_velocity();   ///< 4.12
[[nodiscard]] Figure figure_velocity_error();    ///< 4.13

}  // namespace reckon::bench
