// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What `reckon scene explain` says of what is between peers, and how large things are made.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "reckon/peer/scene/scene_file.hpp"

namespace reckon::tools {

/// (what, how) rows.
using SettingRows = std::vector<std::pair<std::string, std::string>>;

/// What the scene asks of the network, of cells and of dead reckoning. Up to some seconds where the
/// scene has a sample of places; asks the host how many groups it lets one join.
[[nodiscard]] SettingRows scene_settings(const peer::SceneFile& file);

/// How large things are made, and what is left out beyond.
[[nodiscard]] SettingRows scene_limits(const peer::SceneFile& file);

}  // namespace reckon::tools
