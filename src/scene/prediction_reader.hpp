// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reads the sections of a scene file on prediction: when to send, and how to show. Private to the
// scene reader.
#pragma once

#include "reckon/peer/scene/peer_config.hpp"
#include "reckon/peer/scene/toml_reader.hpp"

namespace reckon::peer {

/// Section [dead_reckoning]; what is wrong becomes a problem of `table`.
void read_dead_reckoning(TomlReader& table, DeadReckoningConfig& out);
/// Section [convergence], likewise.
void read_convergence(TomlReader& table, ConvergenceConfig& out);

}  // namespace reckon::peer
