// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The thesis' drawings of chapters 3 and 4, drawn again from its text and equations: two-ports,
// loops and lines, each with the library functions that compute it.
#pragma once

#include "reckon/bench/studies/figures/figure.hpp"

namespace reckon::bench {

[[nodiscard]] Figure drawing_two_port();           ///< 3.2
[[nodiscard]] Figure drawing_display();            ///< 3.3
[[nodiscard]] Figure drawing_stand_alone();        ///< 3.4
[[nodiscard]] Figure drawing_networked_pair();     ///< 4.1
[[nodiscard]] Figure drawing_signal_graph();       ///< 4.2
[[nodiscard]] Figure drawing_delayed_junction();   ///< 4.5
[[nodiscard]] Figure drawing_transmission_line();  ///< 4.6
[[nodiscard]] Figure drawing_environments();       ///< 4.7

}  // namespace reckon::bench
