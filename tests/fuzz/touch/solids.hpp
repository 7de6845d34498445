// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What stands beside each hand of a scenario and never moves.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "reckon/haptics/scene/scene.hpp"
#include "reckon/tests/fuzz/touch/scenario.hpp"
#include "reckon/tests/haptics/support/drawn_touch.hpp"

namespace reckon::fuzz {

inline constexpr double kRegion = 0.03;  // [m], radius of a region

/// A wall, and a second object: another wall, a box, a box with a pit or a tetrahedron.
/// @param home of the hand [m]  @param drawn besides, about it; may be null
[[nodiscard]] haptics::Scene solids_of(const Scenario& scenario, const Eigen::Vector3d& home,
                                       const haptics::Scene* drawn = nullptr);
/// What is drawn beside the first hand, if anything.
[[nodiscard]] std::optional<test::DrawnTouch> drawn_of(const Scenario& scenario);

}  // namespace reckon::fuzz
