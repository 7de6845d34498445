// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Thesis Figs 3.5 to 3.8: one user pushes a device against a wall of order 1 to 4, in both readings
// of the spring.
#pragma once

#include "reckon/bench/studies/figures/figure.hpp"

namespace reckon::bench {

[[nodiscard]] Figure figure_low_order_force();      ///< 3.5
[[nodiscard]] Figure figure_low_order_velocity();   ///< 3.6
[[nodiscard]] Figure figure_high_order_force();     ///< 3.7
[[nodiscard]] Figure figure_high_order_velocity();  ///< 3.8

}  // namespace reckon::bench
