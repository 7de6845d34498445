// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How little of a body may resist a push at its surface: forces that are held for a period and
// depend on the body's speed must not turn it around.
#pragma once

#include "reckon/haptics/scene/effect_plan.hpp"

namespace reckon::haptics {

/// Least effective mass [kg] against a push anywhere on the body's surface and in any direction,
/// moving and turning. Exact for a ball, and for a box at its corners; of a solid without
/// closed form it is that of its mesh, and infinite where it has no end. Some milliseconds for a
/// mesh.
/// @param body has a mass
[[nodiscard]] double least_mass_of(const PlannedObject& body);

}  // namespace reckon::haptics
