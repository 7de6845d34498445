// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What `reckon scene explain` says of the groups of a scene: those of cells, of what is felt and of
// near rows, who hands them out, and what of this host keeps them from being joined.
#pragma once

#include <string>
#include <vector>

#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tools/verbs/scene_settings.hpp"

namespace reckon::tools {

/// "239.192.1.0:3000 and 64 after it; the radius needs up to 19 of them".
[[nodiscard]] std::string groups_text(const peer::SceneFile& file);

/// Who hands out groups, which there are beside those of cells, and the beacons by which cells are
/// found.
void add_group_rows(const peer::SceneFile& file, SettingRows& rows);

/// What of this host keeps the groups from being joined, with the remedy; asks the host.
[[nodiscard]] std::vector<std::string> group_warnings(const peer::SceneFile& file);

}  // namespace reckon::tools
