// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Finds bodies that begin inside other objects which bodies cannot pass through.
#pragma once

#include <vector>

#include "reckon/haptics/scene/effect_plan.hpp"
#include "reckon/peer/scene/scene_file.hpp"

namespace reckon::tools {

/// Bodies at rest have some depth; a depth up to this is not reported [m].
inline constexpr double kDepthAtRest = 10e-6;

/// One problem for each pair of a body and another body, box, sphere, plane or mesh in which it
/// begins, with the depth and the translation that separates them. In the order of the file.
/// Implicit solids are left out: bodies pass through them. Some milliseconds for a body in a mesh.
[[nodiscard]] std::vector<peer::SceneProblem> crowded_bodies(const haptics::EffectPlan& plan);

}  // namespace reckon::tools
