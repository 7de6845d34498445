// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Rules of `reckon inspect check` about motion: the stated velocity and turn rate of an entity
// against its positions and orientations. A frozen entity (appearance bit 21) is left out.
#pragma once

#include <optional>

#include "reckon/tools/inspect/check/rules.hpp"

namespace reckon::tools {

[[nodiscard]] std::optional<RuleFault> static_moves(const CheckedPdu& checked);
/// Positions that contradict the velocities, found with the third update in a row.
[[nodiscard]] std::optional<RuleFault> velocity_contradicts(const CheckedPdu& checked);
/// Angles out of their range, once per entity; else an orientation that contradicts the turn rates,
/// or flips back and forth under a model without a turn rate, found with the third update in a row.
[[nodiscard]] std::optional<RuleFault> wrong_orientation(const CheckedPdu& checked);
/// A float64 instead of an articulated part's float32 and its padding.
[[nodiscard]] std::optional<RuleFault> float64_parameter(const CheckedPdu& checked);

/// Stores the motion of an Entity State in the memory of its entity.
void remember_motion(EntityMemory& memory, const CheckedPdu& checked);

}  // namespace reckon::tools
