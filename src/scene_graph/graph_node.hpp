// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Declaration of a scene graph: nodes by name, each with its parent, and the check for faults
// before a graph is made.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/peer/scene_graph/node_motion.hpp"
#include "reckon/peer/scene_graph/node_pose.hpp"

namespace reckon::peer {

/// Role of a node in the walk.
enum class NodeKind : std::uint8_t {
  content,          ///< a leaf: geometry or a light
  group,            ///< a frame for the nodes below it
  switch_,          ///< procedural: one of its children is shown
  level_of_detail,  ///< procedural: the distance determines the shown child
};

/// Content of a node; `index` counts in a list of the graph's user.
struct NodeContent {
  enum class Kind : std::uint8_t { geometry, light };
  Kind kind = Kind::geometry;
  std::uint32_t index = 0;     ///< of the geometry or light
  std::uint32_t geometry = 0;  ///< of its shape, which instances share
};

/// One declared node. The children of a parent are in the order of the list.
struct GraphNode {
  std::string name{};                   ///< unique, except for content nodes
  std::optional<std::string> parent{};  ///< not a content node; none: this is the root
  NodeKind kind = NodeKind::group;
  NodePose pose{};                     ///< in the parent; for the root in S
  std::optional<NodeMotion> motion{};  ///< motion over time, from `pose`; makes the node procedural
  std::string shows{};                 ///< switch: the name of a child; empty: the first
  /// Child of a level of detail: greatest distance at which it is shown [m, of the level's frame].
  double farthest = std::numeric_limits<double>::infinity();
  NodeContent content{};  ///< of a content node
};

/// A violated rule of a node.
struct GraphFault {
  std::size_t node = 0;  ///< in the list
  /// The member that violates it: "name", "parent", "scale", "farthest"...
  std::string_view member;
  std::string sentence;  ///< error and remedy
};

/// The faults of a list of nodes; none: a SceneGraph can be made of it. The rules: one root; each
/// parent is in the list; no cycles; names are unique; content has no children; poses are finite
/// and scales above 0; a switch shows one of its children; levels of detail have increasing
/// distances.
[[nodiscard]] std::vector<GraphFault> faults_of(std::span<const GraphNode> nodes);

/// The index of each node's parent in a list without faults; the root has the list's size.
[[nodiscard]] std::vector<std::size_t> parents_of(std::span<const GraphNode> nodes);

/// The children of each node, in the list's order. @param parents from parents_of()
[[nodiscard]] std::vector<std::vector<std::size_t>> children_of(
    std::span<const std::size_t> parents);

}  // namespace reckon::peer
