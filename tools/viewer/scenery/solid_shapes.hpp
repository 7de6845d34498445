// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The solids of a scene as a page draws them: planes, balls and boxes by their measures, everything
// else as triangles.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/haptics/scene/scene.hpp"

namespace reckon::tools {

/// One solid; the page knows the names of the shapes: "plane", "sphere", "box", "mesh".
struct DrawnSolid {
  std::string name;
  std::string_view shape;
  haptics::ObjectPose pose;                        ///< a plane's free side is its +z
  double radius = 0;                               ///< [m] of a sphere
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  ///< [m] of a box
  std::vector<Eigen::Vector3d> vertices;           ///< [m] of a mesh, object axes
  std::vector<std::array<std::uint32_t, 3>> triangles;
  double stiffness = 0;  ///< [N/m]
  double friction = 0;   ///< static coefficient; 0: smooth
};

/// All of a scene, in its order. Of a solid made of parts those that are added; one whose mesh
/// cannot be read, or has more than `most` triangles, is its bounding box. Reads mesh files.
[[nodiscard]] std::vector<DrawnSolid> drawn_solids(const haptics::Scene& scene,
                                                   std::size_t most = 200'000);

}  // namespace reckon::tools
