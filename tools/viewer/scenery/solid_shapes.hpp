// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The solids of a scene for a page: planes, spheres and boxes by their dimensions, all others as
// triangles.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/haptics/scene/scene.hpp"

namespace reckon::tools {

/// One solid. Shape names that the page knows: "plane", "sphere", "box", "mesh".
struct DrawnSolid {
  std::string name;
  std::string_view shape;
  haptics::ObjectPose pose;                        ///< +z of a plane is its free side
  double radius = 0;                               ///< [m] of a sphere
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  ///< [m] of a box
  std::vector<Eigen::Vector3d> vertices;           ///< [m] of a mesh, object axes
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint16_t> patches;    ///< of each triangle, 0: none; empty: no patches
  std::vector<std::string> patch_names;  ///< from patch 1 on
  /// Number of its patch 0 in the numbering over all solids, >= 1; 0 if it has none.
  std::uint16_t first_patch = 0;
  std::optional<std::uint16_t> body;  ///< of a moving solid: its number among the bodies
  double stiffness = 0;               ///< [N/m]
  double friction = 0;                ///< static coefficient; 0: smooth
};

/// All solids of a scene, in its order. Of a CSG solid the added parts are drawn; a solid whose
/// mesh cannot be read, or has more than `most` triangles, is drawn as its bounding box. Reads mesh
/// files.
[[nodiscard]] std::vector<DrawnSolid> drawn_solids(const haptics::Scene& scene,
                                                   std::size_t most = 200'000);

/// The regions of a scene that have a shape, in its order, without their effects.
[[nodiscard]] std::vector<DrawnSolid> drawn_regions(const haptics::Scene& scene);

/// The number, over all solids, of patch `patch` of a mesh that is touched at `point` [m, S]; 0
/// if there is none. If several meshes have a patch of this number, the nearest mesh counts; the
/// search costs some ns for each of their corners.
[[nodiscard]] std::uint16_t touched_patch(std::span<const DrawnSolid> solids, std::uint32_t patch,
                                          const Eigen::Vector3d& point);

}  // namespace reckon::tools
