// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The scene graph of a scene file: its [[node]] tables with all copies expanded, and the objects
// that hang on them (docs/scene_graph.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/haptics/scene/scene.hpp"
#include "reckon/peer/scene/graph/scene_graph.hpp"

namespace reckon::peer {

/// One [[node]] table as written.
struct NodeConfig {
  std::string name;
  std::string parent;  ///< empty: the scene's root
  std::string use;     ///< the node that it is a copy of; empty: none
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
  NodeIndex node;        ///< a leaf; its world pose is that of the object
  std::uint32_t object;  ///< in Scene::objects; if it is not felt, in SceneNodes::unfelt
  std::uint32_t table;   ///< of the [[object]], from 0: the same for all copies of one
  bool felt;             ///< else it lies below a node that a switch hides, or in a coarser level
};

/// An object that a time function moves: at each time its pose is world(node) of the graph, and its
/// surface moves by velocity(node). Who moves it evaluates the graph once for each time, and then
/// goes through these.
struct MovedObject {
  std::uint32_t object;  ///< in Scene::objects; its pose there is that of time 0
  NodeIndex node;        ///< the leaf that it is
};

/// What a file's nodes come to. Without [[node]] tables all of it is empty.
struct SceneNodes {
  SceneGraph graph;                ///< its root is S and has no name
  std::vector<HungObject> hung;    ///< in the order of the walk
  std::vector<MovedObject> moved;  ///< those of `hung` that are felt and move; the same order
  std::vector<haptics::SceneObject> unfelt;
};

/// What is wrong with a node or with an object's place in the graph.
struct NodeProblem {
  std::string path;  ///< for TomlReader::problem_at, as "node[1].use"
  std::string sentence;
};

/// Most nodes and objects in a graph, copies counted.
inline constexpr std::size_t kMostNodes = 100'000;
/// Most nodes from the root to an object, and most copies of copies.
inline constexpr std::size_t kMostLevels = 256;

/// Makes the graph. The objects that hang on a node get their pose in S and its scale; copies are
/// added at the end, as "COPY/NAME"; those that are not felt are taken out.
/// @param hung_on of each object the name of its node; empty: none
/// @param problems what forbids it is added; the result is then empty and `objects` as before
[[nodiscard]] SceneNodes make_nodes(std::span<const NodeConfig> nodes,
                                    std::span<const std::string> hung_on,
                                    std::vector<haptics::SceneObject>& objects,
                                    std::vector<NodeProblem>& problems);

}  // namespace reckon::peer
