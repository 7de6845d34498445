// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Rate limit of the force in one servo step: its decrease is free, its growth and rotation are
// limited.
#pragma once

#include "reckon/haptics/passivity/split.hpp"

namespace reckon::haptics {

/// Whether `wanted` is at most `most` [N] from some fraction of `held`.
template <int axes>
[[nodiscard]] bool within_reach(const AxisForces<axes>& held, const AxisForces<axes>& wanted,
                                double most) noexcept;

/// `wanted` if it is within reach, else the nearest force within reach: `held` first decreases,
/// then moves by `most` towards `wanted`. All [N], one frame, finite. @param most >= 0
template <int axes>
[[nodiscard]] AxisForces<axes> nearest_in_reach(const AxisForces<axes>& held,
                                                const AxisForces<axes>& wanted,
                                                double most) noexcept;

/// Largest fraction of `wanted`, in [0, 1], that is within reach.
template <int axes>
[[nodiscard]] double part_in_reach(const AxisForces<axes>& held, const AxisForces<axes>& wanted,
                                   double most) noexcept;

}  // namespace reckon::haptics
