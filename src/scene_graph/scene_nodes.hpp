// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The scene graph of a scene file: its [[node]] tables with all copies expanded, and their objects
// (docs/scene_graph.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "reckon/haptics/scene/scene.hpp"
#include "reckon/peer/scene_graph/scene_graph.hpp"

namespace reckon::peer {

/// One [[node]] table as written.
struct NodeConfig {
  std::string name;
  std::string parent;  ///< empty: the scene's root
  std::string use;     ///< the original of a copy; empty: no copy
  NodeKind kind = NodeKind::group;
  std::string shows;                                          ///< switch; empty: the first
  double farthest = std::numeric_limits<double>::infinity();  ///< of a level of detail [m]
  Eigen::Vector3d position = Eigen::Vector3d::Zero();         ///< [m], parent
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  double scale = 1.0;
  NodeMotion motion;
};

/// An object of the file, or a copy of one, in the graph.
struct HungObject {
  NodeIndex node;        ///< a leaf; its world pose is the pose of the object
  std::uint32_t object;  ///< index in Scene::objects; if it is not felt, in SceneNodes::unfelt
  std::uint32_t table;   ///< index of the [[object]]: the same for all its copies
  bool felt;             ///< false: hidden by a switch, or in a coarser level of detail
};

/// An object moved by a time function: its pose is world(node) of the graph, and its surface moves
/// by velocity(node). The user evaluates the graph once for each time, and then updates these
/// objects.
struct MovedObject {
  std::uint32_t object;  ///< in Scene::objects; its pose there is the one at time 0
  NodeIndex node;        ///< the leaf of the object
};

/// The resulting graph. Empty without [[node]] tables.
struct SceneNodes {
  SceneGraph graph;                ///< its root is S and has no name
  std::vector<HungObject> hung;    ///< in walk order
  std::vector<MovedObject> moved;  ///< the entries of `hung` that are felt and move; in the same
                                   ///< order
  std::vector<haptics::SceneObject> unfelt;
};

/// A fault of a node or of an object's place in the graph.
struct NodeProblem {
  std::string path;  ///< for TomlReader::problem_at, such as "node[1].use"
  std::string sentence;
};

/// Limit of nodes and objects in a graph, including copies.
inline constexpr std::size_t kMostNodes = 100'000;
/// Limit of levels from the root to an object, and of copies of copies.
inline constexpr std::size_t kMostLevels = 256;

/// Makes the graph. Sets the pose in S and the scale of objects with a node; appends copies as
/// "COPY/NAME"; removes objects that are not felt.
/// @param hung_on the name of each object's node; empty: none
/// @param problems faults are appended; the result is then empty and `objects` unchanged
[[nodiscard]] SceneNodes make_nodes(std::span<const NodeConfig> nodes,
                                    std::span<const std::string> hung_on,
                                    std::vector<haptics::SceneObject>& objects,
                                    std::vector<NodeProblem>& problems);

}  // namespace reckon::peer
