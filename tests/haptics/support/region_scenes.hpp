// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Scenes of one region, and the default energy input of oscillations.
#pragma once

#include <optional>
#include <utility>

#include "reckon/haptics/scene/scene.hpp"

namespace reckon::haptics::bench {

inline constexpr double kOscillationPower = 0.1;    ///< [W]
inline constexpr double kOscillationEnergy = 0.02;  ///< [J]

inline SceneRegion region(std::optional<Shape> shape = std::nullopt) {
  SceneRegion out;
  out.name = "region";
  out.shape = std::move(shape);
  return out;
}
inline Scene of(const SceneRegion& one) {
  Scene scene;
  scene.regions.push_back(one);
  return scene;
}
inline Scene weight(double newtons, std::optional<Shape> shape = std::nullopt) {
  SceneRegion one = region(std::move(shape));
  one.effects.declare<ConstantForce>() = {0, 0, -newtons};
  return of(one);
}

}  // namespace reckon::haptics::bench
