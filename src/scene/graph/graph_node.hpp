// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A scene graph as it is written down: nodes by name, each with its parent. What is wrong with one
// is told here, before a graph is made of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/peer/scene/graph/node_motion.hpp"
#include "reckon/peer/scene/graph/node_pose.hpp"

namespace reckon::peer {

/// What a node is to the walk.
enum class NodeKind : std::uint8_t {
  content,          ///< a leaf: geometry or a light
  group,            ///< a frame for the nodes below it
  switch_,          ///< procedural: of its children one is shown
  level_of_detail,  ///< procedural: which child is shown follows from the distance
};

/// What a content node has; `index` counts in a list of the graph's user.
struct NodeContent {
  enum class Kind : std::uint8_t { geometry, light };
  Kind kind = Kind::geometry;
  std::uint32_t index = 0;     ///< of the thing itself
  std::uint32_t geometry = 0;  ///< of its shape, which instances share
};

/// One node as written down. The order of a parent's children is that of the list.
struct GraphNode {
  std::string name{};                   ///< of nodes that are no content: unlike all others
  std::optional<std::string> parent{};  ///< a node that is no content; none: this is the root
  NodeKind kind = NodeKind::group;
  NodePose pose{};                     ///< in the parent; that of the root in S
  std::optional<NodeMotion> motion{};  ///< in time, from `pose`; such a node is procedural
  std::string shows{};                 ///< switch: the name of a child; empty: the first
  /// Child of a level of detail: it is shown up to this distance [m, of the level's frame].
  double farthest = std::numeric_limits<double>::infinity();
  NodeContent content{};  ///< of a content node
};

/// A rule that a node breaks.
struct GraphFault {
  std::size_t node = 0;  ///< in the list
  /// The member that breaks it: "name", "parent", "scale", "farthest"...
  std::string_view member;
  std::string sentence;  ///< error and remedy
};

/// What is wrong with a list of nodes; nothing: a SceneGraph can be made of it. The rules: one
/// root, and each parent a node of the list; nobody is its own ancestor; names are unlike; nothing
/// hangs on content; poses are finite and scales above 0; a switch shows a child; the levels of
/// detail reach farther and farther.
[[nodiscard]] std::vector<GraphFault> faults_of(std::span<const GraphNode> nodes);

/// The place of each parent in a list without faults; the root has the list's size.
[[nodiscard]] std::vector<std::size_t> parents_of(std::span<const GraphNode> nodes);

/// For each node of the list its children, in the list's order. @param parents of parents_of()
[[nodiscard]] std::vector<std::vector<std::size_t>> children_of(
    std::span<const std::size_t> parents);

}  // namespace reckon::peer
