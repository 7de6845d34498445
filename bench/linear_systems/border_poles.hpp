// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Behaviour of a system on the border of stability, the unit circle. The poles on it are split off,
// so that the rest can be evaluated everywhere on it.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <vector>

#include "reckon/bench/linear_systems/state_space.hpp"

namespace reckon::bench {

/// A pole e^{j angle} on the unit circle, with Q of Q e^{j angle}/(z - e^{j angle}).
struct BorderPole {
  double angle = 0.0;        ///< [rad], -pi to pi
  Eigen::MatrixXcd residue;  ///< Q; Hermitian and >= 0 for a passive system
  bool simple = true;        ///< as many eigenvectors as its multiplicity; else Q is empty
};

/// A sampled system on the unit circle, with its border poles split off.
struct CircleSystem {
  /// Without the border poles, whose -Q/2 is in D. A is upper triangular.
  Eigen::MatrixXcd A, B, C, D;
  std::vector<BorderPole> border;
  std::optional<double> beyond;  ///< frequency [rad/s] of a pole outside, if there is one
  /// [1/s] Continuous systems are mapped by s = scale (z - 1)/(z + 1), which keeps the values of G
  /// on the border; 0 for sampled ones.
  double scale = 0.0;
  double sample_period = 0.0;

  /// Angular frequency [rad/s] of an angle: infinite at pi for a continuous system.
  [[nodiscard]] double frequency_of(double angle) const;
  /// G with -Q/2 in place of the border poles.
  [[nodiscard]] Eigen::MatrixXcd response(double angle) const;
};

/// @throws std::invalid_argument from checked(), and if the numbers of inputs and outputs differ;
/// std::runtime_error if eigenvalues are not found
[[nodiscard]] CircleSystem on_unit_circle(const StateSpace& system);

}  // namespace reckon::bench
