// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Culling and picking in a scene graph by bounds of its content: nodes within a view volume, and
// the first node on a ray.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "reckon/peer/scene_graph/scene_graph.hpp"

namespace reckon::peer {

/// A bounding sphere of content, in the node's frame [m].
struct SphereBounds {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius = 0.0;  ///< >= 0
};

/// A bounding box of content, along the node's axes [m].
struct BoxBounds {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Vector3d half = Eigen::Vector3d::Zero();  ///< half its edges, each >= 0
};

using ContentBounds = std::variant<SphereBounds, BoxBounds>;

/// The points p with normal . p <= offset.
struct HalfSpace {
  Eigen::Vector3d normal;  ///< of length 1, S
  double offset;           ///< [m]
};

/// View volume of the frame `eye`, which looks along its x axis: a truncated pyramid.
/// @param width,height opening angles across y and z [rad], above 0 and below pi
/// @param nearest,farthest along x [m]
[[nodiscard]] std::vector<HalfSpace> view_volume(const NodePose& eye, double width, double height,
                                                 double nearest, double farthest);
/// The box of S between two corners.
[[nodiscard]] std::vector<HalfSpace> box_volume(const Eigen::AlignedBox3d& box);

/// The node that a ray hits.
struct Picked {
  NodeIndex node;
  double distance;  ///< from the ray's origin to the bounds [m]; 0: it begins inside
};

/// Bounds of a graph's content and of its subtrees; searches skip whole subtrees by them. This
/// saves time if the nodes of a subtree are close together. Only shown nodes are found. One thread.
class GraphBounds {
 public:
  struct Entry {
    NodeIndex node;
    ContentBounds bounds;
  };

  /// @param graph outlives this @param entries at most one per node; nodes without an entry have no
  /// bounds
  GraphBounds(const SceneGraph& graph, std::vector<Entry> entries);

  /// Takes the poses of the graph; call it after they have changed and before a search. 20 ns for
  /// each node; allocates nothing.
  void update() noexcept;

  /// Appends to `found` each node with bounds that no half space excludes completely, from left to
  /// right. So a box across a corner of the volume is found too.
  void cull(std::span<const HalfSpace> volume, std::vector<NodeIndex>& found) const;

  /// The node whose bounds the ray enters first; of equal ones the first in walk order.
  /// @param direction of any length > 0
  [[nodiscard]] std::optional<Picked> pick(const Eigen::Vector3d& origin,
                                           const Eigen::Vector3d& direction) const noexcept;

 private:
  [[nodiscard]] const ContentBounds* bounds_of(NodeIndex node) const noexcept;

  const SceneGraph* graph_;
  std::vector<Entry> entries_;
  std::vector<std::int32_t> entry_of_;      ///< by node; -1: without bounds
  std::vector<Eigen::AlignedBox3d> boxes_;  ///< of each subtree, in S; empty: no bounds
};

}  // namespace reckon::peer
