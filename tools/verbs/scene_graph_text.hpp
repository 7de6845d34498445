// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The scene graph in the output of `reckon scene`.
#pragma once

#include <cstddef>

#include "reckon/tools/verbs/scene_settings.hpp"

namespace reckon::tools {

/// Nodes of the scene with all copies, without the root and the objects; 0 without a graph.
[[nodiscard]] std::size_t node_count(const peer::SceneFile& file);

/// Its size, copies, nodes that select or move, and objects that hands do not feel; empty without a
/// graph.
[[nodiscard]] SettingRows scene_graph_rows(const peer::SceneFile& file);

}  // namespace reckon::tools
