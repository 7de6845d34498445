// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Measures the time of each stage of a scene's servo step on this host. It reads the clock of the
// thread's CPU, so that other programs on the host have little effect.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "reckon/haptics/scene/effect_plan.hpp"

namespace reckon::peer {

/// CPU of a servo step without its stages, and of each of them [s].
struct StageCosts {
  double empty = 0.0;          ///< walls and port of a scene without objects
  std::vector<double> stages;  ///< as EffectPlan::stages(); below 0: not measured
  /// CPU of the step that touches the dearest object within all regions, including `empty`.
  double dearest = 0.0;
  std::string dearest_object;  ///< empty: no object was touched
};

/// Objects beyond this number are not measured.
inline constexpr std::size_t kMostMeasured = 64;

/// Presses a probe 1 mm into each object and moves it around, without and with each effect. Some 10
/// ms an object; on a busy host the least of several runs. Effects of a program are not run.
/// @param radius of the probe [m]
[[nodiscard]] StageCosts measure_stages(const haptics::Scene& scene,
                                        const haptics::EffectPlan& plan, double radius);

/// A whole step.
struct DearestStep {
  double seconds = 0.0;  ///< CPU: mean of a round, least of several rounds [s]
  std::string object;    ///< empty: none was touched
};

/// The step that touches the dearest of the objects with unbounded cost: meshes and solids of
/// parts. Within all regions, with all effects except effects of a program. Takes some ms, at most
/// 0.5 s of CPU: objects that remain then are not measured.
/// @param enough [s]: a step that takes less in a short run is not measured further
[[nodiscard]] DearestStep measure_dearest_step(const haptics::Scene& scene,
                                               const haptics::EffectPlan& plan, double radius,
                                               double enough);

}  // namespace reckon::peer
