// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The thesis' drawings of chapter 5, drawn again from its text: scene graph, contact point,
// processes and work space, each with its counterpart in Reckon.
#pragma once

#include "reckon/bench/studies/figures/figure.hpp"

namespace reckon::bench {

[[nodiscard]] Figure drawing_family();           ///< 5.1
[[nodiscard]] Figure drawing_traversal();        ///< 5.2
[[nodiscard]] Figure drawing_contact_point();    ///< 5.3
[[nodiscard]] Figure drawing_processes();        ///< 5.4
[[nodiscard]] Figure drawing_simulation_loop();  ///< 5.5
[[nodiscard]] Figure drawing_work_space();       ///< 5.6

}  // namespace reckon::bench
