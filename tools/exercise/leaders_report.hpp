// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Who leads the scene and its cells, for people and programs.
#pragma once

#include <span>
#include <string>

#include "reckon/peer/world/peer_view.hpp"

namespace reckon::tools {

/// "scene by 1:1, map 3 has 4 cells; cells by 1:1: 3, by 1:2: 1", of all cells in which one of
/// these peers is; with "; beacon gate in cell 7,0" for what is followed. Empty where the scene has
/// no leaders. @param views not null
[[nodiscard]] std::string leaders_text(std::span<const peer::PeerView* const> views);

/// `,"leaders":{..}`, a member of an object of one peer; docs/json_lines.md has its keys. Empty
/// where the scene has no leaders.
[[nodiscard]] std::string leaders_json(const peer::LeadersView& leaders);

}  // namespace reckon::tools
