// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The measured stiffness limit of a device: simulated sample by sample with held forces, by
// bisection between a wall that passes and one that fails.
#pragma once

#include <functional>

#include "reckon/bench/studies/zwidth/device_border.hpp"

namespace reckon::bench {

/// Relative precision of a border.
inline constexpr double kBorderPrecision = 1e-4;

/// Greatest stiffness of a wall from which no hand extracts energy [N/m]. A hand moves the handle
/// to and fro, straight between samples, which loses least in the device's damping, at all
/// frequencies that have whole periods in 20 (2 d + 1) samples (at least 2000). The wall's force of
/// each sample is held over the next step. Passive: force and damping together take energy from the
/// hand at every frequency.
/// @param go_on called now and then; if it returns false, the result is not valid
/// @return 0 if the damper alone produces energy
[[nodiscard]] double energy_border(const ZWidthDevice& device, double wall_damping,
                                   const std::function<bool()>& go_on = {});

/// Least stiffness of a wall at which a handle that nobody holds leaves its rest position [N/m]:
/// both sides of the wall push, the motion between samples is exact, and swings grow. Infinite if
/// none does up to 1000 times the border of the device without damper; 0 if the damper alone makes
/// them grow.
[[nodiscard]] double stability_border(const ZWidthDevice& device, double wall_damping);

}  // namespace reckon::bench
