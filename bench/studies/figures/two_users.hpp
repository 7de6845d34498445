// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Thesis Figs 4.3 and 4.4: two users whose walls are fed with the difference of their speeds.
#pragma once

#include "reckon/bench/analysis/virtual_environment.hpp"
#include "reckon/bench/studies/figures/figure.hpp"

namespace reckon::bench {

[[nodiscard]] Figure figure_two_users_force();     ///< 4.3
[[nodiscard]] Figure figure_two_users_velocity();  ///< 4.4

/// The least delay [samples] at which opposed motion of two users makes the scene unstable.
[[nodiscard]] int least_unstable_delay(SpringReading reading);

}  // namespace reckon::bench
