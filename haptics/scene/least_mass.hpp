// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Least effective mass of a body at its surface. Forces that depend on the body's velocity and are
// held for a period must not reverse it.
#pragma once

#include "reckon/haptics/scene/effect_plan.hpp"

namespace reckon::haptics {

/// Least effective mass [kg], with rotation, for a push at any point of the body's surface and in
/// any direction. Exact for a ball, and for a box at its corners. A solid without closed form uses
/// its mesh; an unbounded solid has an infinite mass. Some milliseconds for a mesh.
/// @param body has a mass
[[nodiscard]] double least_mass_of(const PlannedObject& body);

}  // namespace reckon::haptics
