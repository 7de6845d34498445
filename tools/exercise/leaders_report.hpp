// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reports the leaders of the scene and of its cells, as text and as JSON.
#pragma once

#include <span>
#include <string>

#include "reckon/peer/world/peer_view.hpp"

namespace reckon::tools {

/// "scene by 1:1, map 3 has 4 cells; cells by 1:1: 3, by 1:2: 1" for all cells that contain one of
/// these peers; followed by "; beacon gate in cell 7,0" for each followed beacon. Empty if the
/// scene has no leaders. @param views not null
[[nodiscard]] std::string leaders_text(std::span<const peer::PeerView* const> views);

/// `,"leaders":{..}`, a member of a peer's JSON object; docs/json_lines.md lists its keys. Empty
/// if the scene has no leaders.
[[nodiscard]] std::string leaders_json(const peer::LeadersView& leaders);

}  // namespace reckon::tools
