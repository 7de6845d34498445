// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Finds contacts of two meshes, and selects the few that hold a body best.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "reckon/haptics/bodies/ode_calls.hpp"
#include "reckon/haptics/geometry/surface_mesh.hpp"

namespace reckon::haptics {

/// A mesh with probe points on its surface: corners, and points along long edges. Between them,
/// only the probe points of the other mesh find a contact.
class ProbedMesh {
 public:
  /// Takes at most kMostPoints points.
  explicit ProbedMesh(std::shared_ptr<const SurfaceMesh> mesh);

  static constexpr std::size_t kMostPoints = 2000;

  [[nodiscard]] const SurfaceMesh& mesh() const noexcept { return *mesh_; }
  [[nodiscard]] std::span<const Eigen::Vector3d> points() const noexcept { return points_; }
  [[nodiscard]] std::span<const Eigen::Vector3d> corners() const noexcept { return corners_; }

 private:
  std::shared_ptr<const SurfaceMesh> mesh_;
  std::vector<Eigen::Vector3d> points_, corners_;
};

/// Contacts of two meshes at the poses of their geoms, as dCollide: points of each inside the
/// other, with the way out through the nearest point of its surface. An open mesh has no inside. 1
/// us for each near point. @return number of contacts in `out`
[[nodiscard]] std::size_t meet(const ProbedMesh& a, dGeomID a_at, const ProbedMesh& b, dGeomID b_at,
                               std::span<dContactGeom> out) noexcept;

/// Contacts with a plane: the deepest corner, and the farthest ones in each direction. 2 ns a
/// corner, or O(1) if the mesh is off the plane. @param is_first whether the mesh is the first geom
[[nodiscard]] std::size_t meet_plane(const ProbedMesh& mesh, dGeomID at, dGeomID plane,
                                     bool is_first, std::span<dContactGeom> out) noexcept;

/// Moves the deepest contact, and the three that span most with it, to the front.
/// @return their number, 4 at most
[[nodiscard]] std::size_t keep_widest(std::span<dContactGeom> contacts) noexcept;

}  // namespace reckon::haptics
