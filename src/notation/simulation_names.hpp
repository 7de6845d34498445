// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Lists of simulations in a scene file, for example "1:2, 40:1". Private to the scene reader and
// its rules.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/aoim/groups/peer_id.hpp"

namespace reckon::peer {

/// Parses site:application pairs separated by commas. Returns nothing for any other text. Numbers
/// are 1 to 65534.
[[nodiscard]] std::optional<std::vector<aoim::PeerId>> parse_simulations(std::string_view text);

/// Writes the text that parse_simulations() reads.
[[nodiscard]] std::string simulations_text(const std::vector<aoim::PeerId>& names);

}  // namespace reckon::peer
