// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The scene graph: the parent and the scene pose of each node, in arrays in walk order (top to
// bottom, left to right).
//
//   const std::vector<GraphNode> nodes = {{.name = "scene"},
//                                         {.name = "arm", .parent = "scene"},
//                                         {.name = "hand", .parent = "arm"}};
//   SceneGraph graph(nodes);
//   graph.place(graph.find("arm").value(), {{0, 0, 0.2}});
//   graph.update();
//   graph.world(graph.find("hand").value());
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/peer/scene_graph/graph_node.hpp"
#include "reckon/peer/scene_graph/node_motion.hpp"
#include "reckon/peer/scene_graph/node_pose.hpp"

namespace reckon::peer {

/// The position of a node in the walk, from 0, the root. A node's subtree is the range from its
/// index to end(); its first child follows it directly.
using NodeIndex = std::int32_t;

/// No node: the parent of the root.
inline constexpr NodeIndex kNoNode = -1;

/// The nodes of a scene, in one tree. The shape of the tree is fixed at construction; poses,
/// choices of switches, viewpoint and time change. A change marks a node; the next update() or
/// evaluate() rewrites only the subtrees of marked nodes, from left to right. The result is equal,
/// bit by bit, to the result of rewrite().
///
/// Cost: 7 to 40 ns for each rewritten node, 60 more for one with a time function (graph_bench).
/// After the constructor nothing allocates or throws. One thread at a time; copies are independent.
class SceneGraph {
 public:
  /// Without nodes.
  SceneGraph() = default;
  /// At time 0, seen from the origin of S. @throws std::invalid_argument with the first of
  /// faults_of(nodes)
  explicit SceneGraph(std::span<const GraphNode> nodes);

  [[nodiscard]] NodeIndex size() const noexcept { return static_cast<NodeIndex>(links_.size()); }
  [[nodiscard]] bool empty() const noexcept { return links_.empty(); }
  /// Nodes from the root to the deepest one; 0 without nodes.
  [[nodiscard]] std::size_t depth() const noexcept { return depth_; }

  // Below, each node is one of this graph: 0 <= node < size().

  [[nodiscard]] NodeIndex parent(NodeIndex node) const noexcept { return links_[at(node)].parent; }
  /// The index after the last node of its subtree: its next sibling, if it has one.
  [[nodiscard]] NodeIndex end(NodeIndex node) const noexcept { return links_[at(node)].end; }
  [[nodiscard]] NodeKind kind(NodeIndex node) const noexcept { return links_[at(node)].kind; }
  [[nodiscard]] const std::string& name(NodeIndex node) const noexcept { return name_[at(node)]; }
  [[nodiscard]] const NodeContent& content(NodeIndex node) const noexcept {
    return content_[at(node)];
  }
  /// Its time function; null if it has none.
  [[nodiscard]] const NodeMotion* motion(NodeIndex node) const noexcept;
  /// Whether it or one of its ancestors has a time function.
  [[nodiscard]] bool moves(NodeIndex node) const noexcept { return links_[at(node)].moves; }
  /// For a child of a level of detail: greatest distance at which it is shown [m, of that level's
  /// frame].
  [[nodiscard]] double farthest(NodeIndex node) const noexcept { return farthest_[at(node)]; }
  /// The index of the node at `index` in the list given to the constructor.
  [[nodiscard]] NodeIndex place_of(std::size_t index) const noexcept { return places_[index]; }
  /// The first node with this name; a linear search, for set-up.
  [[nodiscard]] std::optional<NodeIndex> find(std::string_view name) const noexcept;

  // As of the last update() or evaluate():

  /// Pose in the parent, at the time of the last evaluate().
  [[nodiscard]] const NodePose& local(NodeIndex node) const noexcept { return local_[at(node)]; }
  /// Pose in the parent, without its time function.
  [[nodiscard]] const NodePose& rest(NodeIndex node) const noexcept;
  /// Pose in S.
  [[nodiscard]] const NodePose& world(NodeIndex node) const noexcept { return world_[at(node)]; }
  /// Exact velocity of world() by the time functions; zero if moves() is false.
  [[nodiscard]] const NodeVelocity& velocity(NodeIndex node) const noexcept {
    return velocity_[at(node)];
  }
  /// Whether no switch and no level of detail above hides it.
  [[nodiscard]] bool shown(NodeIndex node) const noexcept { return links_[at(node)].shown; }
  /// The child that a switch or a level of detail shows; kNoNode: none, or another kind of node.
  [[nodiscard]] NodeIndex chosen(NodeIndex node) const noexcept;

  // Changes that take effect in the next update() or evaluate():

  /// Sets the pose of a node in its parent; a node with a time function moves from there. The scale
  /// must be above 0 and all values finite. The orientation need not have length 1.
  void place(NodeIndex node, const NodePose& pose) noexcept;
  /// Lets a switch show `child`, one of its children.
  void show(NodeIndex node, NodeIndex child) noexcept;
  /// Sets the viewpoint for levels of detail [m], S.
  void look_from(const Eigen::Vector3d& viewpoint) noexcept;

  /// Rewrites changed subtrees.
  void update() noexcept;
  /// Sets the nodes with time functions to `time`, and rewrites changed subtrees.
  /// @param time since the begin of the scene
  void evaluate(std::chrono::nanoseconds time) noexcept;
  /// Rewrites everything, at the time of the last evaluate().
  void rewrite() noexcept;

 private:
  static constexpr NodeIndex kEvery = -1;  ///< all children are shown
  static constexpr NodeIndex kNone = -2;

  /// All data of a node except its poses.
  struct Link {
    NodeIndex parent, end;
    NodeIndex chosen = kEvery;  ///< a child, kEvery or kNone
    NodeKind kind;
    bool shown = true, moves;
  };

  /// A node with a time function.
  struct Moving {
    NodeIndex node;
    NodePose rest;
    NodeMotion motion;
    NodeVelocity velocity;  ///< in the parent
  };

  static std::size_t at(NodeIndex node) noexcept { return static_cast<std::size_t>(node); }
  void add(const GraphNode& node, NodeIndex parent);
  void choose_first(const GraphNode& node, NodeIndex place);
  [[nodiscard]] Moving* moving(NodeIndex node) noexcept;
  [[nodiscard]] const Moving* moving(NodeIndex node) const noexcept;
  void mark(NodeIndex node) noexcept;
  [[nodiscard]] std::span<const NodeIndex> take_marks() noexcept;
  void mark_other_levels() noexcept;
  void rewrite(NodeIndex begin, NodeIndex end) noexcept;
  void rewrite_velocity(NodeIndex node) noexcept;
  void set_time(Moving& one, std::chrono::nanoseconds time) noexcept;
  [[nodiscard]] NodeIndex level_of(NodeIndex node) const noexcept;

  // Per node, in walk order.
  std::vector<Link> links_;
  std::vector<NodePose> local_, world_;
  std::vector<NodeVelocity> velocity_;
  std::vector<double> farthest_;
  std::vector<NodeContent> content_;
  std::vector<std::string> name_;

  std::vector<NodeIndex> places_;     ///< by index in the constructor's list
  std::vector<Moving> moving_;        ///< in walk order
  std::vector<NodeIndex> levels_;     ///< nodes with levels of detail, in walk order
  std::vector<std::uint64_t> marks_;  ///< one bit for each node
  std::vector<NodeIndex> marked_;     ///< of the last update; only the first ones are used
  bool any_mark_ = false;
  std::size_t depth_ = 0;
  Eigen::Vector3d viewpoint_ = Eigen::Vector3d::Zero();
  bool is_seen_anew_ = false;
  std::chrono::nanoseconds time_{0};
};

}  // namespace reckon::peer
