// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What holds a body at a hand: a spring with viscosity from a point to a point (thesis 2.4.2).
#pragma once

#include <limits>

namespace reckon::haptics {

/// F = -stiffness (hand - body) - viscosity (their speeds' difference), both ways alike.
struct GrabSpring {
  double stiffness = 0.0;                                 ///< [N/m]; 0: it holds nothing
  double viscosity = 0.0;                                 ///< [N s/m] >= 0
  double most = std::numeric_limits<double>::infinity();  ///< [N]; what pulls harder tears it off
};

}  // namespace reckon::haptics
