// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Random scene graphs, and their evaluation by recursion over a tree of pointers with matrices, as
// an oracle that shares no code with SceneGraph.
#pragma once

#include <fmt/format.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <chrono>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "reckon/peer/scene_graph/graph_node.hpp"

namespace reckon::test {

struct GraphShape {
  std::size_t nodes = 1000;
  double up = 1.0;             ///< mean number of levels that the next node goes up
  std::size_t deepest = 1000;  ///< maximum number of levels
  double moving = 0.0;         ///< share of the nodes that have a time function
  double procedural = 0.0;     ///< share that are switches or levels of detail
  double light = 0.0;          ///< share of the leaves that are lights
};

/// Random graphs whose list is in random order, different from the walk.
class RandomGraph {
 public:
  explicit RandomGraph(unsigned seed) : random_(seed) {}

  [[nodiscard]] double between(double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random_);
  }
  [[nodiscard]] std::size_t below(std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_);
  }
  [[nodiscard]] Eigen::Vector3d vector(double size) {
    return {between(-size, size), between(-size, size), between(-size, size)};
  }
  [[nodiscard]] Eigen::Quaterniond turn() {
    return Eigen::Quaterniond(between(-1, 1), between(-1, 1), between(-1, 1), between(0.1, 1))
        .normalized();
  }
  [[nodiscard]] peer::NodePose pose() {
    return {vector(0.2), std::exp(between(-0.1, 0.1)), turn()};
  }

  [[nodiscard]] std::vector<peer::GraphNode> nodes(const GraphShape& shape) {
    std::vector<std::size_t> parents(shape.nodes, shape.nodes);
    std::vector<std::size_t> open{0};
    std::vector<bool> inner(shape.nodes, false);
    for (std::size_t node = 1; node < shape.nodes; ++node) {
      for (double up = between(0, 2 * shape.up + 1); up >= 1.0 && open.size() > 1; up -= 1.0)
        open.pop_back();
      while (open.size() >= shape.deepest) open.pop_back();
      parents[node] = open.back();
      inner[open.back()] = true;
      open.push_back(node);
    }
    std::vector<peer::GraphNode> made(shape.nodes);
    for (std::size_t node = 0; node < shape.nodes; ++node) {
      peer::GraphNode& one = made[node];
      one.name = fmt::format("n{}", node);
      if (node > 0) one.parent = made[parents[node]].name;
      one.pose = pose();
      if (between(0, 1) < shape.moving) one.motion = motion();
      if (!inner[node]) make_leaf(one, node, shape);
      if (inner[node] && between(0, 1) < shape.procedural)
        one.kind = below(2) == 0 ? peer::NodeKind::switch_ : peer::NodeKind::level_of_detail;
    }
    std::map<std::size_t, double> reach;
    for (std::size_t node = 1; node < shape.nodes; ++node) {
      if (made[parents[node]].kind != peer::NodeKind::level_of_detail) continue;
      made[node].farthest = reach[parents[node]] += between(0.05, 0.5);
    }
    return made;
  }

  [[nodiscard]] peer::NodeMotion motion() {
    peer::NodeMotion motion;
    motion.turn_axis = vector(1);
    motion.turn_rate = between(-4, 4);
    motion.swing = vector(0.1);
    motion.swing_rate = between(0, 2);
    motion.swing_phase = between(-3, 3);
    return motion;
  }

 private:
  void make_leaf(peer::GraphNode& one, std::size_t node, const GraphShape& shape) {
    one.kind = peer::NodeKind::content;
    one.content.index = static_cast<std::uint32_t>(node);
    if (between(0, 1) < shape.light) one.content.kind = peer::NodeContent::Kind::light;
  }

  std::mt19937 random_;
};

/// A node of the oracle.
struct OracleNode {
  const peer::GraphNode* written = nullptr;
  std::vector<std::unique_ptr<OracleNode>> children;
};

/// The result of the oracle's visit to a node.
struct OracleVisit {
  std::string name;
  Eigen::Matrix4d world;
  std::vector<std::string> lights;  ///< lights that apply at the node
};

/// Evaluates as the thesis describes: down the first child's branch completely, before the second
/// child's. Switches and levels of detail pass one branch.
class GraphOracle {
 public:
  explicit GraphOracle(const std::vector<peer::GraphNode>& nodes) {
    std::map<std::string, OracleNode*> made;
    // Parents may be listed after their children.
    std::vector<std::unique_ptr<OracleNode>> loose;
    for (const peer::GraphNode& node : nodes) {
      loose.push_back(std::make_unique<OracleNode>());
      loose.back()->written = &node;
      if (node.kind != peer::NodeKind::content) made[node.name] = loose.back().get();
    }
    for (auto& node : loose) {
      const auto parent = node->written->parent;
      (parent ? made.at(*parent)->children.emplace_back() : root_) = std::move(node);
    }
  }

  /// @param all also hidden nodes
  [[nodiscard]] std::vector<OracleVisit> visits(std::chrono::nanoseconds time,
                                                const Eigen::Vector3d& eye, bool all) const {
    std::vector<OracleVisit> visits;
    std::vector<std::string> lights;
    visit(*root_, Eigen::Matrix4d::Identity(), lights, {time, eye, all}, visits);
    return visits;
  }

  [[nodiscard]] static Eigen::Matrix4d matrix(const peer::NodePose& pose) {
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    matrix.topLeftCorner<3, 3>() = pose.scale * pose.orientation.toRotationMatrix();
    matrix.topRightCorner<3, 1>() = pose.position;
    return matrix;
  }

 private:
  struct View {
    std::chrono::nanoseconds time;
    Eigen::Vector3d eye;
    bool all;
  };

  static Eigen::Matrix4d local(const peer::GraphNode& node, std::chrono::nanoseconds time) {
    Eigen::Matrix4d local = matrix(node.pose);
    if (!node.motion) return local;
    const double t = 1e-9 * static_cast<double>(time.count());
    const peer::NodeMotion& motion = *node.motion;
    local.topRightCorner<3, 1>() +=
        motion.swing * std::sin(2 * std::numbers::pi * motion.swing_rate * t + motion.swing_phase);
    Eigen::Matrix4d turned = Eigen::Matrix4d::Identity();
    turned.topLeftCorner<3, 3>() =
        Eigen::AngleAxisd(motion.turn_rate * t, motion.turn_axis.normalized()).toRotationMatrix();
    return local * turned;
  }

  void visit(const OracleNode& node, const Eigen::Matrix4d& above, std::vector<std::string>& around,
             const View& view, std::vector<OracleVisit>& visits) const {
    const Eigen::Matrix4d world = above * local(*node.written, view.time);
    visits.push_back({node.written->name, world, around});
    if (node.written->kind == peer::NodeKind::content) {
      if (node.written->content.kind == peer::NodeContent::Kind::light)
        around.push_back(node.written->name);
      return;
    }
    std::vector<std::string> inside = around;
    const double scale = std::cbrt(world.topLeftCorner<3, 3>().determinant());
    const double distance = (world.topRightCorner<3, 1>() - view.eye).norm() / scale;
    for (const auto& child : node.children) {
      const bool chosen =
          lets_through(*node.written, *child->written, child == node.children.front(), distance);
      if (!chosen && !view.all) continue;
      visit(*child, world, inside, view, visits);
      const bool one = node.written->kind != peer::NodeKind::group;
      if (one && !view.all) break;
    }
  }

  static bool lets_through(const peer::GraphNode& node, const peer::GraphNode& child, bool first,
                           double distance) {
    if (node.kind == peer::NodeKind::switch_)
      return node.shows.empty() ? first : child.name == node.shows;
    if (node.kind == peer::NodeKind::level_of_detail) return distance <= child.farthest;
    return true;
  }

  std::unique_ptr<OracleNode> root_;
};

}  // namespace reckon::test
