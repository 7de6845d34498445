// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What each stage of a scene's servo step takes of this host, measured.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "reckon/tools/verbs/loaded_scene.hpp"

namespace reckon::tools {

/// CPU of a servo step without its stages, and of each of them [s].
struct StageCosts {
  double empty = 0.0;          ///< walls and port of a scene without objects
  std::vector<double> stages;  ///< as EffectPlan::stages(); below 0: not measured
  /// Of the step that touches the dearest object within all regions, with `empty`.
  double dearest = 0.0;
  std::string dearest_object;  ///< empty: no object was touched
};

/// Objects beyond this number are not measured.
inline constexpr std::size_t kMostMeasured = 64;

/// Presses a probe 1 mm into each object and leads it round, without and with each effect. Some 10
/// ms an object; on a busy host the least of some runs. @param radius of the probe [m]
[[nodiscard]] StageCosts measure_stages(const LoadedScene& scene, double radius);

}  // namespace reckon::tools
