// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Simulations of thesis 3.4 and 4.2, from parameters to a time series: one user at a virtual wall,
// and two users with walls on the difference of their speeds. Off-line code.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "reckon/bench/analysis/hybrid_motion.hpp"
#include "reckon/bench/analysis/networked_pair.hpp"
#include "reckon/bench/analysis/virtual_environment.hpp"

namespace reckon::bench {

/// Thesis Fig 3.4 with its numbers. The device is exact between samples, with a held force.
struct OneUserScene {
  double mass = 1.0;            ///< [kg] > 0
  double damping = 0.5;         ///< b of the device [N s/m]
  double stiffness = 0.2;       ///< K_e, depends on the reading
  double wall_damping = 0.1;    ///< b_e [N s/m]
  double sample_period = 0.01;  ///< T [s] > 0
  SpringReading reading = SpringReading::with_period;
  /// Order of the environment: 1 the wall; 2 with a lag; 3 with poles on the imaginary axis; 4
  /// both. The additions have static gain 1 (the thesis prints no numbers for them).
  int order = 1;
  double lag_pole = 0.6;    ///< alpha of the lag (1 - alpha) z/(z - alpha), in z
  double resonance = 10.0;  ///< of the poles +-j w [rad/s]
  double push = 1.0;        ///< of the user, from `push_from` on [N]
  double push_from = 0.0;   ///< [s]
  double duration = 20.0;   ///< [s]
  MotionState start;
  /// Fig 3.3: the environment acts on one side only, on the depth behind this position [m], and
  /// never pulls. Without a value the environment acts on the speed at any position.
  std::optional<double> wall;
};

/// State of the device at a sample, and the force that is held from there on.
struct SceneSample {
  double time = 0.0;      ///< [s]
  double position = 0.0;  ///< [m]
  double velocity = 0.0;  ///< [m/s]
  double force = 0.0;     ///< of the environment, against the motion [N]
};

/// The scene's environment, speed to force. @throws std::invalid_argument if the order is not 1 to
/// 4
[[nodiscard]] TransferFunction environment_of(const OneUserScene& scene);
/// Spectral radius of its loop: above 1 the envelope grows by this factor each sample.
[[nodiscard]] double loop_radius(const OneUserScene& scene);
/// Samples 0, T, .., duration. @throws std::invalid_argument for invalid parameters
[[nodiscard]] std::vector<SceneSample> run(const OneUserScene& scene);
/// The same with another environment of the same period instead of the scene's (5.4, 5.5).
[[nodiscard]] std::vector<SceneSample> run(const OneUserScene& scene,
                                           const TransferFunction& environment);

/// Thesis Fig 4.1: both users push from the start.
struct TwoUserScene {
  PairParameters pair;
  std::array<double, 2> push = {1.0, 1.0};  ///< [N]
  double duration = 20.0;                   ///< [s]
};
[[nodiscard]] std::vector<std::array<SceneSample, 2>> run(const TwoUserScene& scene);
/// The same with another environment instead of the wall (4.21, 5.4, 5.5).
[[nodiscard]] std::vector<std::array<SceneSample, 2>> run(const TwoUserScene& scene,
                                                          const TransferFunction& environment);

}  // namespace reckon::bench
