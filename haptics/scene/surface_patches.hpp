// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Surface patches of a mesh: the declared ones of a scene, matched to the materials and groups of
// the mesh file. Made once at load.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "reckon/haptics/scene/scene.hpp"

namespace reckon::haptics {

class SurfaceMesh;

/// Parameters at a point of a surface. Without friction both coefficients are 0.
struct SurfaceFeel {
  Surface surface;
  Friction friction{0.0, 0.0};
};

/// One patch of a mesh, or the object's own surface.
struct PlannedPatch {
  std::string name;  ///< empty for the object's own surface
  SurfaceFeel feel;
  std::size_t triangles = 0;
};

/// The patches of one mesh, numbered from 1 in the order of their first use in its file. So the
/// numbers are the same for all readers of the file, in any order of declaration. Number 0 is the
/// object's own surface, for all triangles in no patch.
struct SurfacePatches {
  std::vector<PlannedPatch> patches;       ///< by number; at least one
  std::vector<std::uint16_t> of_triangle;  ///< as SurfaceMesh::triangles()
  std::vector<std::string> missing;        ///< declared names without triangles
  std::vector<std::string> in_file;        ///< names in the file

  [[nodiscard]] const SurfaceFeel& feel_of(std::uint32_t patch) const noexcept {
    return patches[patch].feel;
  }
};

/// If both the material and the group of a triangle are patches, the material counts.
/// @return null for an object without patches.
/// @throws std::invalid_argument naming the patch, the value and the remedy.
[[nodiscard]] std::shared_ptr<const SurfacePatches> plan_patches(const SceneObject& object,
                                                                 const SurfaceMesh& mesh);

/// Remarks for the user, a sentence each: names that are not found, triangles in no patch.
[[nodiscard]] std::vector<std::string> patch_notes(const SurfacePatches& patches);

}  // namespace reckon::haptics
