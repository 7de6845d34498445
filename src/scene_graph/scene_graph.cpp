// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/scene_graph/scene_graph.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <stdexcept>
#include <utility>

namespace reckon::peer {
namespace {

NodePose with_unit_turn(NodePose pose) noexcept {
  pose.orientation.normalize();
  return pose;
}

}  // namespace

SceneGraph::SceneGraph(std::span<const GraphNode> nodes) {
  if (const auto faults = faults_of(nodes); !faults.empty())
    throw std::invalid_argument(faults.front().sentence);
  const std::vector<std::size_t> parents = parents_of(nodes);
  const std::vector<std::vector<std::size_t>> children = children_of(parents);
  places_.resize(nodes.size());
  const auto root = std::ranges::find(parents, nodes.size()) - parents.begin();
  // The next node is on top of the stack, so children are pushed in reverse order.
  std::vector<std::pair<std::size_t, std::size_t>> open{{static_cast<std::size_t>(root), 1}};
  while (!open.empty()) {
    const auto [index, depth] = open.back();
    open.pop_back();
    places_[index] = size();
    depth_ = std::max(depth_, depth);
    add(nodes[index], parents[index] == nodes.size() ? kNoNode : places_[parents[index]]);
    for (auto child = children[index].rbegin(); child != children[index].rend(); ++child)
      open.emplace_back(*child, depth + 1);
  }
  for (NodeIndex node = size() - 1; node > 0; --node)
    links_[at(parent(node))].end = std::max(end(parent(node)), end(node));
  for (std::size_t index = 0; index < nodes.size(); ++index)
    choose_first(nodes[index], places_[index]);
  marks_.resize(nodes.size() / 64 + 1);
  marked_.resize(nodes.size());
  for (Moving& one : moving_) set_time(one, time_);
  rewrite();
}

void SceneGraph::add(const GraphNode& node, NodeIndex parent) {
  const NodeIndex place = size();
  const bool moves = node.motion && node.motion->moves();
  links_.push_back({.parent = parent,
                    .end = place + 1,
                    .kind = node.kind,
                    .moves = moves || (parent != kNoNode && this->moves(parent))});
  local_.push_back(with_unit_turn(node.pose));
  world_.emplace_back();
  velocity_.emplace_back();
  farthest_.push_back(node.farthest);
  content_.push_back(node.content);
  name_.push_back(node.name);
  if (moves) moving_.push_back({place, local_.back(), *node.motion, {}});
  if (node.kind == NodeKind::level_of_detail) levels_.push_back(place);
}

// A switch without children shows none.
void SceneGraph::choose_first(const GraphNode& node, NodeIndex place) {
  if (node.kind != NodeKind::switch_) return;
  NodeIndex child = place + 1;
  while (child < end(place) && !node.shows.empty() && name(child) != node.shows) child = end(child);
  links_[at(place)].chosen = child < end(place) ? child : kNone;
}

SceneGraph::Moving* SceneGraph::moving(NodeIndex node) noexcept {
  return const_cast<Moving*>(std::as_const(*this).moving(node));
}

const SceneGraph::Moving* SceneGraph::moving(NodeIndex node) const noexcept {
  const auto found = std::ranges::lower_bound(moving_, node, {}, &Moving::node);
  return found != moving_.end() && found->node == node ? &*found : nullptr;
}

const NodeMotion* SceneGraph::motion(NodeIndex node) const noexcept {
  const Moving* const one = moving(node);
  return one != nullptr ? &one->motion : nullptr;
}

const NodePose& SceneGraph::rest(NodeIndex node) const noexcept {
  const Moving* const one = moving(node);
  return one != nullptr ? one->rest : local(node);
}

std::optional<NodeIndex> SceneGraph::find(std::string_view name) const noexcept {
  const auto found = std::ranges::find(name_, name);
  if (found == name_.end()) return std::nullopt;
  return static_cast<NodeIndex>(found - name_.begin());
}

NodeIndex SceneGraph::chosen(NodeIndex node) const noexcept {
  return std::max(links_[at(node)].chosen, kNoNode);
}

void SceneGraph::mark(NodeIndex node) noexcept {
  marks_[at(node) / 64] |= std::uint64_t{1} << (at(node) % 64);
  any_mark_ = true;
}

// Collects the marks from left to right, in a list with room for all.
std::span<const NodeIndex> SceneGraph::take_marks() noexcept {
  if (!any_mark_) return {};
  any_mark_ = false;
  std::size_t count = 0;
  for (std::size_t word = 0; word < marks_.size(); ++word) {
    for (std::uint64_t& left = marks_[word]; left != 0; left &= left - 1)
      marked_[count++] = static_cast<NodeIndex>(64 * word) + std::countr_zero(left);
  }
  return std::span(marked_).first(count);
}

void SceneGraph::place(NodeIndex node, const NodePose& pose) noexcept {
  assert(pose.scale > 0.0 && pose.position.allFinite() && pose.orientation.norm() > 1e-6);
  if (Moving* const one = moving(node)) {
    one->rest = with_unit_turn(pose);
    set_time(*one, time_);
  } else {
    local_[at(node)] = with_unit_turn(pose);
  }
  mark(node);
}

void SceneGraph::show(NodeIndex node, NodeIndex child) noexcept {
  assert(kind(node) == NodeKind::switch_ && parent(child) == node);
  if (links_[at(node)].chosen == child) return;
  links_[at(node)].chosen = child;
  mark(node);
}

void SceneGraph::look_from(const Eigen::Vector3d& viewpoint) noexcept {
  viewpoint_ = viewpoint;
  is_seen_anew_ = true;
}

void SceneGraph::set_time(Moving& one, std::chrono::nanoseconds time) noexcept {
  const MovedPose now = moved(one.rest, one.motion, time);
  local_[at(one.node)] = now.pose;
  one.velocity = now.velocity;
}

void SceneGraph::evaluate(std::chrono::nanoseconds time) noexcept {
  if (time != time_) {
    time_ = time;
    for (Moving& one : moving_) {
      set_time(one, time);
      mark(one.node);
    }
  }
  update();
}

// For a node whose pose is about to change, this may find a wrong level. The node is then marked,
// which costs time but changes nothing; or it is in a marked subtree, whose level is chosen again.
void SceneGraph::mark_other_levels() noexcept {
  if (!is_seen_anew_) return;
  is_seen_anew_ = false;
  for (const NodeIndex node : levels_) {
    if (level_of(node) != links_[at(node)].chosen) mark(node);
  }
}

// Changed nodes are scattered in memory; prefetching reduces the cost to a third. This is no
// separate function, because GCC 12 removes calls of a function that only prefetches.
void SceneGraph::update() noexcept {
  constexpr std::size_t kAhead = 8;
  mark_other_levels();
  const std::span<const NodeIndex> marked = take_marks();
  NodeIndex done = 0;
  for (std::size_t i = 0; i < marked.size(); ++i) {
    if (i + 2 * kAhead < marked.size()) {
      __builtin_prefetch(&links_[at(marked[i + 2 * kAhead])]);
      const NodeIndex next = marked[i + kAhead];
      const NodeIndex above = std::max(parent(next), 0);
      __builtin_prefetch(&local_[at(next)]);
      __builtin_prefetch(&world_[at(next)], 1);
      __builtin_prefetch(&links_[at(above)]);
      __builtin_prefetch(&world_[at(above)]);
    }
    if (marked[i] < done) continue;
    done = end(marked[i]);
    rewrite(marked[i], done);
  }
}

void SceneGraph::rewrite() noexcept {
  std::ranges::fill(marks_, 0);
  any_mark_ = false;
  is_seen_anew_ = false;
  rewrite(0, size());
}

// From left to right, a parent is rewritten before its children.
void SceneGraph::rewrite(NodeIndex begin, NodeIndex end) noexcept {
  for (NodeIndex node = begin; node < end; ++node) {
    Link& link = links_[at(node)];
    if (link.parent == kNoNode) {
      world_[at(node)] = local(node);
    } else {
      const Link& above = links_[at(link.parent)];
      world_[at(node)] = placed(world(link.parent), local(node));
      link.shown = above.shown && (above.chosen == kEvery || above.chosen == node);
    }
    if (link.moves) rewrite_velocity(node);
    if (link.kind == NodeKind::level_of_detail) link.chosen = level_of(node);
  }
}

void SceneGraph::rewrite_velocity(NodeIndex node) noexcept {
  const Moving* const one = moving(node);
  const NodeVelocity own = one != nullptr ? one->velocity : NodeVelocity{};
  const NodeIndex above = parent(node);
  velocity_[at(node)] =
      above == kNoNode ? own : carried(world(above), velocity(above), local(node).position, own);
}

NodeIndex SceneGraph::level_of(NodeIndex node) const noexcept {
  const double distance = (viewpoint_ - world(node).position).norm() / world(node).scale;
  for (NodeIndex child = node + 1; child < end(node); child = end(child)) {
    if (distance <= farthest_[at(child)]) return child;
  }
  return kNone;
}

}  // namespace reckon::peer
