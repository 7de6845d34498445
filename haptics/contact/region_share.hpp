// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Stiffness limit of regions beside walls, and damping limit of objects.
#pragma once

namespace reckon::haptics {

/// Greatest stiffness of the potentials of all regions together, over the walls': static_cap()
/// leaves them a quarter of the whole.
inline constexpr double kRegionsOverWalls = 1.0 / 3.0;
/// The same for grab springs.
inline constexpr double kGrabOverWalls = kRegionsOverWalls;
/// Greatest share of the device's damping that static_cap() reserves for dampers of objects: half
/// of the three quarters for surfaces.
inline constexpr double kMostDamperShare = 0.375;

}  // namespace reckon::haptics
