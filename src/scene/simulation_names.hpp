// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Simulations that a scene names, as in "1:2, 40:1". Private to the scene reader and its rules.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/aoim/groups/peer_id.hpp"

namespace reckon::peer {

/// The site:application pairs of a text, separated by commas; nothing where it is none. 0 and 65535
/// name no simulation.
[[nodiscard]] std::optional<std::vector<aoim::PeerId>> parse_simulations(std::string_view text);

/// As parse_simulations() takes it.
[[nodiscard]] std::string simulations_text(const std::vector<aoim::PeerId>& names);

}  // namespace reckon::peer
