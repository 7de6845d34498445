// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/verbs/scene_meshes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <variant>

#include "reckon/haptics/geometry/surface_mesh.hpp"
#include "reckon/tools/terminal/json_text.hpp"

namespace reckon::tools {
namespace {

// Hands work near the origin of S [m]; a mesh farther away was probably drawn elsewhere.
constexpr double kFarFromHands = 100.0;

void note_distance(const haptics::PlannedObject& object, std::vector<std::string>& notes) {
  const double distance = object.bounds.exteriorDistance(Eigen::Vector3d::Zero());
  if (distance <= kFarFromHands) return;
  notes.push_back(fmt::format(
      "is {} from the scene's origin, where hands are: write centre = true, and a position",
      haptics::length_text(distance)));
}

// The file of a mesh, or of the picture of a height field.
std::string file_of(const haptics::Shape& shape) {
  const auto* picture = std::get_if<haptics::HeightsShape>(&shape);
  return (picture != nullptr ? picture->file : std::get<haptics::MeshShape>(shape).file).string();
}

// Numbered patches: a list of name and triangle count.
void append_patches(std::string& out, const haptics::SurfacePatches* patches) {
  out += '[';
  for (std::size_t id = 1; patches != nullptr && id < patches->patches.size(); ++id) {
    if (id > 1) out += ',';
    JsonObject(out)
        .value("patch", id)
        .text("name", patches->patches[id].name)
        .value("triangles", patches->patches[id].triangles)
        .end();
  }
  out += ']';
}

}  // namespace

std::string mesh_line(const MeshFacts& facts) {
  std::string text = haptics::mesh_summary(facts.report);
  if (facts.patches == nullptr) return text;
  std::string patches;
  for (std::size_t id = 1; id < facts.patches->patches.size(); ++id) {
    const haptics::PlannedPatch& patch = facts.patches->patches[id];
    patches += fmt::format("{}{} {} ({})", id > 1 ? ", " : "", id, patch.name, patch.triangles);
  }
  return text + "; patches: " + (patches.empty() ? "none found" : patches);
}

std::vector<MeshFacts> mesh_facts(const LoadedScene& scene) {
  std::vector<MeshFacts> facts;
  const auto& planned = scene.plan.objects();
  for (std::size_t i = 0; i < planned.size(); ++i) {
    if (!planned[i].is_mesh()) continue;
    using Mesh = std::shared_ptr<const haptics::SurfaceMesh>;
    const haptics::MeshReport& report = std::get<Mesh>(planned[i].shape)->report();
    MeshFacts& row =
        facts.emplace_back(MeshFacts{planned[i].name, file_of(scene.file.scene.objects[i].shape),
                                     report, planned[i].patches, haptics::mesh_notes(report)});
    note_distance(planned[i], row.notes);
    if (row.patches == nullptr) continue;
    std::ranges::copy(haptics::patch_notes(*row.patches), std::back_inserter(row.notes));
  }
  return facts;
}

void append_mesh_json(std::string& out, const MeshFacts& facts, std::string_view kind) {
  const haptics::MeshReport& report = facts.report;
  JsonObject row(out);
  if (!kind.empty()) row.text("kind", kind);
  row.text("object", facts.object)
      .text("file", facts.file)
      .array("extent_m", report.extent,
             [](std::string& text, double edge) { text += fmt::format("{:.9g}", edge); })
      .value("triangles", report.triangles)
      .value("vertices", report.vertices)
      .value("pieces", report.pieces)
      .value("closed", report.closed)
      .value("volume_m3", report.closed ? fmt::format("{:.9g}", report.volume) : "null")
      .value("faces", report.faces)
      .value("polygons_cut", report.polygons.count)
      .value("vertices_merged", report.merged_vertices)
      .value("degenerate_dropped", report.dropped_degenerate.count)
      .value("duplicates_dropped", report.dropped_duplicates.count)
      .value("triangles_turned", report.turned.count)
      .value("pieces_turned", report.inward_pieces)
      .value("boundary_edges", report.boundary_edges.count)
      .value("holes", report.holes)
      .value("non_manifold_edges", report.non_manifold_edges.count)
      .value("non_manifold_vertices", report.non_manifold_vertices.count)
      .value("one_sided_edges", report.one_sided_edges)
      .array("notes", facts.notes, append_json_string);
  append_patches(row.member("patches"), facts.patches.get());
  row.end();
}

}  // namespace reckon::tools
