// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What `reckon scene explain` says of the cells of a scene.
#pragma once

#include <string>

#include "reckon/peer/scene/peer_config.hpp"

namespace reckon::tools {

/// "square, 200 m", "quad-tree of 64 cells in a square of 4096 m: 3 of 1024 m, 61 of 256 m".
[[nodiscard]] std::string cells_text(const peer::AoimConfig& aoim);

/// How much more is heard than is wanted of the scene's sample of places, with its cells and with
/// equal ones; empty where there is no sample. Up to some seconds.
[[nodiscard]] std::string over_delivery_text(const peer::AoimConfig& aoim);

}  // namespace reckon::tools
