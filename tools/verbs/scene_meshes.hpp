// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Output of `reckon scene check` and `scene explain` about the meshes of a scene: their size and
// every repair.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/haptics/geometry/mesh_report.hpp"
#include "reckon/haptics/scene/surface_patches.hpp"
#include "reckon/tools/verbs/loaded_scene.hpp"

namespace reckon::tools {

/// One object with a mesh.
struct MeshFacts {
  std::string object;
  std::string file;
  haptics::MeshReport report;
  std::shared_ptr<const haptics::SurfacePatches> patches;  ///< null if none is declared
  std::vector<std::string> notes;  ///< remarks for the user, without the object's name
};

/// haptics::mesh_summary(), and the patches by number with their triangles: "...; patches: 1 soft
/// (12), 2 hard (4)".
[[nodiscard]] std::string mesh_line(const MeshFacts& facts);

/// Facts in the order of the scene.
[[nodiscard]] std::vector<MeshFacts> mesh_facts(const LoadedScene& scene);

/// Appends the keys of docs/json_lines.md as one JSON object; `kind` is its first key unless empty.
void append_mesh_json(std::string& out, const MeshFacts& facts, std::string_view kind = {});

}  // namespace reckon::tools
