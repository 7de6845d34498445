// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Output of `reckon scene explain` about the settings between peers, and about capacities.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "reckon/peer/scene/scene_file.hpp"

namespace reckon::tools {

/// (what, how) rows.
using SettingRows = std::vector<std::pair<std::string, std::string>>;

/// The scene's settings for the network, cells and dead reckoning. Up to some seconds if the scene
/// has a sample of positions. Queries the host for the number of groups that it can join.
[[nodiscard]] SettingRows scene_settings(const peer::SceneFile& file);

/// Capacities, and the items that are dropped beyond them.
[[nodiscard]] SettingRows scene_limits(const peer::SceneFile& file);

}  // namespace reckon::tools
