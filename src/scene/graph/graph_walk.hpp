// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The walk through a scene graph with a state that nodes modify on the way: top to bottom, left to
// right (thesis fig 5.2).
//
//   GraphWalk<int> walk(graph);                       // depth as a state
//   walk.run(0, [](NodeIndex node, int& own, int&) { ++own; return true; });
#pragma once

#include <span>
#include <vector>

#include "reckon/peer/scene/graph/scene_graph.hpp"

namespace reckon::peer {

/// Walks through the shown nodes of a graph, which outlives it. Allocates when it is made; run()
/// does not, unless copies of State do.
template <class State>
class GraphWalk {
 public:
  explicit GraphWalk(const SceneGraph& graph) : graph_(&graph), open_(graph.depth() + 1) {}

  /// Calls `visit(node, own, around)` for each shown node. `own` is what the walk brought to the
  /// node; modified, it holds for what hangs on the node. `around`, modified, holds for the later
  /// siblings of the node and what hangs on them. On the way up the states of before hold again.
  /// If `visit` returns false, nothing below the node is visited.
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
    NodeIndex end = 0;  ///< behind the last node for which it holds
  };

  const SceneGraph* graph_;
  std::vector<Open> open_;
};

/// A node with geometry as the walk comes to it.
struct DrawnNode {
  NodeIndex node;
  const NodePose& pose;               ///< in S
  std::span<const NodeIndex> lights;  ///< the lights that hold for it, in the order of the walk
};

/// Draws a scene: a node's pose holds for all below it; a light holds for its later siblings and
/// all below them (thesis 5.2: it "is added to the currently active set of lights").
class DrawWalk {
 public:
  /// @param graph outlives the walk
  explicit DrawWalk(const SceneGraph& graph)
      : graph_(&graph), walk_(graph), lights_(static_cast<std::size_t>(graph.size())) {}

  /// Calls `draw(DrawnNode)` for each shown geometry, from left to right. Allocates nothing.
  template <class Draw>
  void run(Draw draw) {
    walk_.run({}, [&](NodeIndex node, State& own, State& around) {
      own.pose = placed(around.pose, graph_->local(node));
      if (graph_->kind(node) != NodeKind::content) return true;
      if (graph_->content(node).kind == NodeContent::Kind::light)
        lights_[around.lights++] = node;  // over those of subtrees that are left
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
