// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The smoothness of a vehicle in a steady turn, as a viewer sees it over a poor link: a fixed case
// that any program can run, with limits to meet.
#pragma once

#include <cstdint>
#include <vector>

#include "reckon/bench/studies/accuracy/study.hpp"

namespace reckon::bench {

/// Radius 100 m at 20 m/s, seen at 60 Hz for 60 s; an update every 0.2 s with a delay of 80 ms +-40
/// %; 10 % are lost.
struct CircleCase {
  double seconds = 60;
  double period = 0.2;                                               ///< [s]
  peer::ImpairmentConfig network{peer::delayed_by(0.08, 0.4, 0.1)};  ///< its seed is the first
  std::uint64_t seeds = 100;                                         ///< medians over these
};

/// Limits for the medians.
inline constexpr double kCircleError = 0.005;       ///< RMS [m]
inline constexpr double kCircleVelocityStep = 0.1;  ///< largest [m/s]; the circle's own is 0.067

struct CircleRow {
  PoseModel model;
  deadreckon::ConvergenceCurve curve = deadreckon::ConvergenceCurve::cubic;
  PoseResult result;

  [[nodiscard]] bool clears() const noexcept {
    return result.position.rms <= kCircleError && result.velocity_step.max <= kCircleVelocityStep;
  }
};

/// Every model with every curve. Deterministic.
[[nodiscard]] std::vector<CircleRow> run_circle_study(
    std::span<const PoseModel> models, std::span<const deadreckon::ConvergenceCurve> curves,
    const CircleCase& circle = {});

}  // namespace reckon::bench
