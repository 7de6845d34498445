// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Where two meshes touch, and the few contacts of many that hold a body best.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "reckon/haptics/bodies/ode_calls.hpp"
#include "reckon/haptics/geometry/surface_mesh.hpp"

namespace reckon::haptics {

/// A mesh with the points of its surface that are looked for in others: corners, and places along
/// long edges. Between them another mesh is met by its own points, or not at all.
class ProbedMesh {
 public:
  /// Of at most kMostPoints.
  explicit ProbedMesh(std::shared_ptr<const SurfaceMesh> mesh);

  static constexpr std::size_t kMostPoints = 2000;

  [[nodiscard]] const SurfaceMesh& mesh() const noexcept { return *mesh_; }
  [[nodiscard]] std::span<const Eigen::Vector3d> points() const noexcept { return points_; }
  [[nodiscard]] std::span<const Eigen::Vector3d> corners() const noexcept { return corners_; }

 private:
  std::shared_ptr<const SurfaceMesh> mesh_;
  std::vector<Eigen::Vector3d> points_, corners_;
};

/// Contacts of two meshes at the places of their geoms, as dCollide: points of each that are inside
/// the other one, with the way out over the nearest place of its surface. What is open has no
/// inside. 1 us for each point that is near. @return how many of `out` are set
[[nodiscard]] std::size_t meet(const ProbedMesh& a, dGeomID a_at, const ProbedMesh& b, dGeomID b_at,
                               std::span<dContactGeom> out) noexcept;

/// Contacts with a plane: the deepest corner, and those farthest out each way. 2 ns a corner; none
/// of them where the mesh is beyond it. @param is_first whether the mesh is the first geom
[[nodiscard]] std::size_t meet_plane(const ProbedMesh& mesh, dGeomID at, dGeomID plane,
                                     bool is_first, std::span<dContactGeom> out) noexcept;

/// Brings the deepest contact and three that span most with it to the front.
/// @return how many there are, 4 at most
[[nodiscard]] std::size_t keep_widest(std::span<dContactGeom> contacts) noexcept;

}  // namespace reckon::haptics
