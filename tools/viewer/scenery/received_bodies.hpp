// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Bodies of a scene where the states of their owners show them.
#pragma once

#include <span>

#include "reckon/tools/viewer/history/roster.hpp"
#include "reckon/tools/viewer/protocol/picture.hpp"
#include "reckon/tools/viewer/scenery/solid_shapes.hpp"

namespace reckon::tools {

/// Places the carried bodies of a picture at its entities; a body without an entity stays. A
/// program that simulates nothing has no bodies in `rows`: they are added, if at least one is
/// received.
void place_received_bodies(std::span<const DrawnSolid> solids, const Roster& roster,
                           PictureRows& rows);

}  // namespace reckon::tools
