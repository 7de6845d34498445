// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The static objects beside each hand of a scenario.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "reckon/haptics/scene/scene.hpp"
#include "reckon/tests/fuzz/touch/scenario.hpp"
#include "reckon/tests/haptics/support/drawn_touch.hpp"

namespace reckon::fuzz {

inline constexpr double kRegion = 0.03;  // [m], radius of a region

/// A wall, and a second object: another wall, a box, a box with a pit or a tetrahedron.
/// @param home of the hand [m] @param drawn additional objects about it; may be null
[[nodiscard]] haptics::Scene solids_of(const Scenario& scenario, const Eigen::Vector3d& home,
                                       const haptics::Scene* drawn = nullptr);
/// The random objects beside the first hand, if any.
[[nodiscard]] std::optional<test::DrawnTouch> drawn_of(const Scenario& scenario);

}  // namespace reckon::fuzz
