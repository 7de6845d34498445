// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How stiff regions may be beside walls, and what dampers of objects may take.
#pragma once

namespace reckon::haptics {

/// Stiffness that the potentials of all regions together may have, over that of walls: static_cap()
/// leaves a quarter of the whole to them.
inline constexpr double kRegionsOverWalls = 1.0 / 3.0;
/// The same of what holds bodies.
inline constexpr double kGrabOverWalls = kRegionsOverWalls;
/// Share of the device's own damping that static_cap() keeps for dampers of objects at most: half
/// of the three quarters on which surfaces may lean.
inline constexpr double kMostDamperShare = 0.375;

}  // namespace reckon::haptics
