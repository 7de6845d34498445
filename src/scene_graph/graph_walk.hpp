// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Walks a scene graph with a state that nodes modify: top to bottom, left to right (thesis fig
// 5.2).
//
//   GraphWalk<int> walk(graph);                       // depth as a state
//   walk.run(0, [](NodeIndex node, int& own, int&) { ++own; return true; });
#pragma once

#include <span>
#include <vector>

#include "reckon/peer/scene_graph/scene_graph.hpp"

namespace reckon::peer {

/// Walks the shown nodes of a graph, which outlives it. Allocates at construction; run() does not,
/// unless copies of State do.
template <class State>
class GraphWalk {
 public:
  explicit GraphWalk(const SceneGraph& graph) : graph_(&graph), open_(graph.depth() + 1) {}

  /// Calls `visit(node, own, around)` for each shown node. `own` is the state at the node; changes
  /// of it apply to the node's subtree. Changes of `around` apply to the later siblings of the node
  /// and their subtrees. On the way up the earlier states are restored. If `visit` returns false,
  /// the subtree below the node is skipped.
  template <class Visit>
  void run(const State& initial, Visit visit) {
    std::size_t level = 0;  // of open_: the state around the node
    open_[0] = {initial, graph_->size()};
    for (NodeIndex node = 0; node < graph_->size();) {
      while (node >= open_[level].end) --level;
      if (!graph_->shown(node)) {
        node = graph_->end(node);
        continue;
      }
      Open& below = open_[level + 1];
      below = {open_[level].state, graph_->end(node)};
      const bool descends = visit(node, below.state, open_[level].state);
      if (descends && graph_->end(node) > node + 1) ++level;
      node = descends ? node + 1 : graph_->end(node);
    }
  }

 private:
  struct Open {
    State state{};
    NodeIndex end = 0;  ///< after the last node to which it applies
  };

  const SceneGraph* graph_;
  std::vector<Open> open_;
};

/// A geometry node during the walk.
struct DrawnNode {
  NodeIndex node;
  const NodePose& pose;               ///< in S
  std::span<const NodeIndex> lights;  ///< active lights, in walk order
};

/// Draws a scene: a node's pose applies to its subtree; a light applies to its later siblings and
/// their subtrees (thesis 5.2: it "is added to the currently active set of lights").
class DrawWalk {
 public:
  /// @param graph outlives the walk
  explicit DrawWalk(const SceneGraph& graph)
      : graph_(&graph), walk_(graph), lights_(static_cast<std::size_t>(graph.size())) {}

  /// Calls `draw(DrawnNode)` for each shown geometry, from left to right. Allocates nothing.
  void run(auto draw) {
    walk_.run({}, [&](NodeIndex node, State& own, State& around) {
      own.pose = placed(around.pose, graph_->local(node));
      if (graph_->kind(node) != NodeKind::content) return true;
      if (graph_->content(node).kind == NodeContent::Kind::light)
        lights_[around.lights++] = node;  // overwrites lights of finished subtrees
      else
        draw(DrawnNode{node, own.pose, std::span(lights_).first(around.lights)});
      return true;
    });
  }

 private:
  struct State {
    NodePose pose;
    std::size_t lights = 0;
  };

  const SceneGraph* graph_;
  GraphWalk<State> walk_;
  std::vector<NodeIndex> lights_;
};

}  // namespace reckon::peer
