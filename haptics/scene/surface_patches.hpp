// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Which part of a mesh feels how: the patches that a scene declares, found among the materials and
// groups of the mesh file. Made once at load.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "reckon/haptics/scene/scene.hpp"

namespace reckon::haptics {

class SurfaceMesh;

/// How a place of a surface feels. Without friction both coefficients are 0.
struct SurfaceFeel {
  Surface surface;
  Friction friction{0.0, 0.0};
};

/// One patch of a mesh, or what is in none.
struct PlannedPatch {
  std::string name;  ///< empty for the object's own surface
  SurfaceFeel feel;
  std::size_t triangles = 0;
};

/// The patches of one mesh, numbered from 1 in the order in which its file first says their names:
/// the same for all who read the same file, in whatever order a scene declares them. Number 0 is
/// what the object declares, for all triangles that are in none.
struct SurfacePatches {
  std::vector<PlannedPatch> patches;       ///< by number; at least one
  std::vector<std::uint16_t> of_triangle;  ///< as SurfaceMesh::triangles()
  std::vector<std::string> missing;        ///< names that a scene declares and no triangle has
  std::vector<std::string> in_file;        ///< names that the file has

  [[nodiscard]] const SurfaceFeel& feel_of(std::uint32_t patch) const noexcept {
    return patches[patch].feel;
  }
};

/// Where a triangle has a material and a group that are both patches, the material counts.
/// @return null for an object that declares no patch.
/// @throws std::invalid_argument naming the patch, the value and the remedy.
[[nodiscard]] std::shared_ptr<const SurfacePatches> plan_patches(const SceneObject& object,
                                                                 const SurfaceMesh& mesh);

/// What a person should look at, a sentence each: names that are not found, triangles in no patch.
[[nodiscard]] std::vector<std::string> patch_notes(const SurfacePatches& patches);

}  // namespace reckon::haptics
