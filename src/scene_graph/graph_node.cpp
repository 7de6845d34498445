// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/scene_graph/graph_node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

namespace reckon::peer {
namespace {

using Places = std::unordered_map<std::string_view, std::size_t>;

/// Collects the faults of one list.
class GraphCheck {
 public:
  explicit GraphCheck(std::span<const GraphNode> nodes)
      : nodes_(nodes), parents_(nodes.size(), nodes.size()) {}

  std::vector<GraphFault> faults() {
    if (nodes_.empty()) add(0, "parent", "a scene graph needs a root: add a node without a parent");
    check_names();
    check_parents();
    if (faults_.empty()) check_circles();
    for (std::size_t node = 0; node < nodes_.size(); ++node) check_pose(node);
    if (faults_.empty()) check_procedures();
    return std::move(faults_);
  }

 private:
  void add(std::size_t node, std::string_view member, std::string sentence) {
    faults_.push_back({node, member, std::move(sentence)});
  }

  void check_names() {
    for (std::size_t node = 0; node < nodes_.size(); ++node) {
      const std::string& name = nodes_[node].name;
      if (nodes_[node].kind == NodeKind::content) {
        leaves_.emplace(name, node);
      } else if (!places_.emplace(name, node).second) {
        add(node, "name", fmt::format("there is another node '{}': rename one", name));
      }
    }
  }

  void check_parents() {
    std::optional<std::size_t> root;
    for (std::size_t node = 0; node < nodes_.size(); ++node) {
      const std::string& name = nodes_[node].name;
      const std::optional<std::string>& parent = nodes_[node].parent;
      if (!parent && root) {
        add(node, "parent",
            fmt::format("'{}' is a second root beside '{}': give it a parent", name,
                        nodes_[*root].name));
      } else if (!parent) {
        root = node;
      } else if (const auto found = places_.find(*parent); found != places_.end()) {
        parents_[node] = found->second;
      } else {
        add(node, "parent",
            leaves_.contains(*parent)
                ? fmt::format("the parent of '{}', '{}', is a leaf: name a node", name, *parent)
                : fmt::format("the parent of '{}', '{}', is not in this graph: name a node of it",
                              name, *parent));
      }
    }
  }

  // Nodes that do not reach the root by their parents are in a cycle, or below one.
  void check_circles() {
    enum : std::uint8_t { unseen, open, seen };
    std::vector<std::uint8_t> state(nodes_.size(), unseen);
    for (std::size_t start = 0; start < nodes_.size(); ++start) {
      std::size_t node = start;
      for (; node < nodes_.size() && state[node] == unseen; node = parents_[node])
        state[node] = open;
      if (node < nodes_.size() && state[node] == open) tell_circle(node);
      for (node = start; node < nodes_.size() && state[node] == open; node = parents_[node])
        state[node] = seen;
    }
  }

  void tell_circle(std::size_t start) {
    constexpr std::size_t kNamed = 8;
    std::string way = fmt::format("'{}'", nodes_[start].name);
    std::size_t node = parents_[start];
    for (std::size_t steps = 1; node != start && steps < kNamed; ++steps, node = parents_[node])
      way += fmt::format(" on '{}'", nodes_[node].name);
    way += node == start ? fmt::format(" on '{}'", nodes_[start].name) : " and so on";
    add(start, "parent",
        fmt::format("a node is its own ancestor, {}: give one of them another parent", way));
  }

  void check_pose(std::size_t node) {
    const GraphNode& one = nodes_[node];
    if (!(one.pose.scale > 0.0) || !std::isfinite(one.pose.scale))
      add(node, "scale",
          fmt::format("the scale of '{}' is not above 0: write one above 0", one.name));
    if (!one.pose.position.allFinite())
      add(node, "position", fmt::format("the position of '{}' is not finite", one.name));
    if (!(one.pose.orientation.norm() > 1e-6) || !one.pose.orientation.coeffs().allFinite())
      add(node, "orientation", fmt::format("the orientation of '{}' is not a rotation", one.name));
    if (const auto fault = one.motion ? fault_of(*one.motion) : std::nullopt)
      add(node, "motion", fmt::format("'{}': {}", one.name, *fault));
  }

  void check_procedures() {
    const auto children = children_of(parents_);
    for (std::size_t node = 0; node < nodes_.size(); ++node) {
      check_switch(node, children[node]);
      check_levels(node, children[node]);
    }
  }

  void check_switch(std::size_t node, const std::vector<std::size_t>& children) {
    const GraphNode& one = nodes_[node];
    if (one.kind != NodeKind::switch_ && !one.shows.empty())
      return add(node, "shows",
                 fmt::format("'{}' is not a switch, and only a switch shows one of its children",
                             one.name));
    const auto named = [&](std::size_t child) { return nodes_[child].name == one.shows; };
    if (one.shows.empty() || std::ranges::any_of(children, named)) return;
    add(node, "shows",
        fmt::format("'{}' shows '{}', which is not its child: name a child", one.name, one.shows));
  }

  void check_levels(std::size_t node, const std::vector<std::size_t>& children) {
    const bool levels = nodes_[node].kind == NodeKind::level_of_detail;
    double before = 0.0;
    for (const std::size_t child : children) {
      const double farthest = nodes_[child].farthest;
      if (!levels && std::isfinite(farthest)) {
        add(child, "farthest",
            fmt::format(
                "'{}' is not a child of a level of detail, and only those have a greatest distance",
                nodes_[child].name));
      } else if (levels && !(farthest > before)) {
        add(child, "farthest",
            fmt::format("'{}' is never shown, because a level before it reaches as far: let each "
                        "reach farther, and only the last be unbounded",
                        nodes_[child].name));
      }
      before = farthest;
    }
  }

  std::span<const GraphNode> nodes_;
  Places places_, leaves_;
  std::vector<std::size_t> parents_;
  std::vector<GraphFault> faults_;
};

}  // namespace

std::vector<GraphFault> faults_of(std::span<const GraphNode> nodes) {
  return GraphCheck(nodes).faults();
}

std::vector<std::size_t> parents_of(std::span<const GraphNode> nodes) {
  Places places;
  for (std::size_t node = 0; node < nodes.size(); ++node)
    if (nodes[node].kind != NodeKind::content) places.emplace(nodes[node].name, node);
  std::vector<std::size_t> parents(nodes.size(), nodes.size());
  for (std::size_t node = 0; node < nodes.size(); ++node)
    if (nodes[node].parent) parents[node] = places.at(*nodes[node].parent);
  return parents;
}

std::vector<std::vector<std::size_t>> children_of(std::span<const std::size_t> parents) {
  std::vector<std::vector<std::size_t>> children(parents.size());
  for (std::size_t node = 0; node < parents.size(); ++node)
    if (parents[node] < parents.size()) children[parents[node]].push_back(node);
  return children;
}

}  // namespace reckon::peer
