// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// [[node]], and the key `node` of objects. Private to the scene reader.
#pragma once

#include <string>
#include <vector>

#include "reckon/peer/scene/scene_sections.hpp"

namespace reckon::peer {

[[nodiscard]] Section<NodeConfig> node_section();

/// Makes the scene graph of a file whose nodes and objects are read.
/// @param hung_on the name of each object's node; empty: none
void hang_objects(TomlReader& file, const std::vector<std::string>& hung_on, SceneFile& out);

}  // namespace reckon::peer
