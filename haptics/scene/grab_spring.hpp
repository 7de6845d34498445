// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Holds a body at a hand: a spring with viscosity between two points (thesis 2.4.2).
#pragma once

#include <limits>

namespace reckon::haptics {

/// F = -stiffness (hand - body) - viscosity (difference of their velocities), equal and opposite.
struct GrabSpring {
  double stiffness = 0.0;                                 ///< [N/m]; 0: no hold
  double viscosity = 0.0;                                 ///< [N s/m] >= 0
  double most = std::numeric_limits<double>::infinity();  ///< [N]; a greater pull breaks the hold
};

}  // namespace reckon::haptics
