// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What stands beside each hand of a scenario and never moves.
#pragma once

#include <Eigen/Core>

#include "reckon/haptics/scene/effect_plan.hpp"
#include "reckon/tests/fuzz/touch/scenario.hpp"

namespace reckon::fuzz {

/// A wall, and a second object: another wall, a box, a box with a pit or a tetrahedron.
/// @param home of the hand [m]
[[nodiscard]] haptics::EffectPlan solids_of(const Scenario& scenario, const Eigen::Vector3d& home);

}  // namespace reckon::fuzz
