// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Output of `reckon scene explain` about the cells of a scene.
#pragma once

#include <string>

#include "reckon/peer/settings/aoim_config.hpp"

namespace reckon::tools {

/// "square, 200 m", "quad-tree of 64 cells in a square of 4096 m: 3 of 1024 m, 61 of 256 m".
[[nodiscard]] std::string cells_text(const peer::AoimConfig& aoim);

/// Over-delivery for the scene's sample of positions, with its cells and with equal ones; empty
/// without a sample. Up to some seconds.
[[nodiscard]] std::string over_delivery_text(const peer::AoimConfig& aoim);

}  // namespace reckon::tools
