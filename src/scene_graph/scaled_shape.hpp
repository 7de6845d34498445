// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Scales objects that the graph places. Private to the scene reader.
#pragma once

#include <optional>
#include <string>

#include "reckon/haptics/scene/scene.hpp"
#include "reckon/peer/scene_graph/node_pose.hpp"

namespace reckon::peer {

/// Sets the pose and the size of an object in S. @return the fault, if any: too far away, too large
/// or small, or a mesh whose size is defined only by its file
[[nodiscard]] std::optional<std::string> put_at(const NodePose& pose, haptics::SceneObject& object);

}  // namespace reckon::peer
