// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Output of `reckon scene explain` about the groups of a scene: groups for cells, contacts and near
// tiers, the peers that assign them, and limits of this host for joining them.
#pragma once

#include <string>
#include <vector>

#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tools/verbs/scene_settings.hpp"

namespace reckon::tools {

/// "239.192.1.0:3000 and 64 after it; the radius needs up to 19 of them".
[[nodiscard]] std::string groups_text(const peer::SceneFile& file);

/// Rows for the peers that assign groups, the groups not used for cells, and the beacons of cells.
void add_group_rows(const peer::SceneFile& file, SettingRows& rows);

/// Limits of this host that prevent joining the groups, with the remedy; queries the host.
[[nodiscard]] std::vector<std::string> group_warnings(const peer::SceneFile& file);

}  // namespace reckon::tools
