// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The stiffness that a device can show, measured: sample by sample with forces that are held, by
// halving the stiffness between a wall that passes and one that fails.
#pragma once

#include <functional>

#include "reckon/bench/studies/zwidth/device_border.hpp"

namespace reckon::bench {

/// Share of its value to which a border is found.
inline constexpr double kBorderPrecision = 1e-4;

/// Stiffest wall of which no hand takes energy [N/m]. A hand moves the handle to and fro, straight
/// between samples, which loses least in the device's damping, at all frequencies that have whole
/// periods in 20 (2 d + 1) samples (2000 at least); the wall's force of each sample is held over
/// the next step. Passive: force and damping together take energy from the hand at every one.
/// @param go_on asked now and then; where it says false, the answer is of no use
/// @return 0 where the damper alone makes energy
[[nodiscard]] double energy_border(const ZWidthDevice& device, double wall_damping,
                                   const std::function<bool()>& go_on = {});

/// Softest wall at which a handle that nobody holds comes off its rest [N/m]: both sides of the
/// wall push, the motion between samples is exact, and swings grow. Infinite where none up to 1000
/// times that of the device without damper does; 0 where the damper alone makes them grow.
[[nodiscard]] double stability_border(const ZWidthDevice& device, double wall_damping);

}  // namespace reckon::bench
