// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Bodies of a scene that begin inside something that bodies do not pass through.
#pragma once

#include <vector>

#include "reckon/haptics/scene/effect_plan.hpp"
#include "reckon/peer/scene/scene_file.hpp"

namespace reckon::tools {

/// Bodies rest at some depth; what begins no deeper than this is no finding [m].
inline constexpr double kDepthAtRest = 10e-6;

/// One for each pair of a body and another body, box, ball, plane or mesh that it begins in, with
/// the depth and the translation that parts them. In the order of the file. Solids of a signed
/// function are left out: bodies pass through them. Some milliseconds for a body in a mesh.
[[nodiscard]] std::vector<peer::SceneProblem> crowded_bodies(const haptics::EffectPlan& plan);

}  // namespace reckon::tools
