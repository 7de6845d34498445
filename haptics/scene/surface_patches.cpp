// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/scene/surface_patches.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "reckon/haptics/geometry/surface_mesh.hpp"
#include "reckon/haptics/input_files/load_budget.hpp"

namespace reckon::haptics {

namespace {

constexpr std::size_t kNamed = 6;  // names listed in a notice

PlannedPatch planned(const SurfacePatch& patch) {
  try {
    const SpringDamper surface(patch.surface);
    PlannedPatch out{patch.name, {patch.surface, {0.0, 0.0}}, 0};
    if (patch.friction) out.feel.friction = StickSlipFriction(*patch.friction).parameters();
    return out;
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument("patch \"" + patch.name + "\": " + error.what());
  }
}

void check_names(const std::vector<SurfacePatch>& patches) {
  for (auto patch = patches.begin(); patch != patches.end(); ++patch) {
    if (patch->name.empty()) {
      throw std::invalid_argument("a patch has no name: write the name of a material or group");
    }
    if (std::ranges::find(patch + 1, patches.end(), patch->name, &SurfacePatch::name) !=
        patches.end()) {
      throw std::invalid_argument("patch \"" + patch->name + "\" exists twice: keep one");
    }
  }
  if (patches.size() >= std::numeric_limits<std::uint16_t>::max()) {
    throw std::invalid_argument("more than 65534 patches; declare fewer");
  }
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < std::min(kNamed, names.size()); ++i) {
    text += (i == 0 ? "" : ", ") + names[i];
  }
  if (names.size() > kNamed) text += " and " + std::to_string(names.size() - kNamed) + " more";
  return text;
}

}  // namespace

std::shared_ptr<const SurfacePatches> plan_patches(const SceneObject& object,
                                                   const SurfaceMesh& mesh) {
  if (object.patches.empty()) return nullptr;
  check_names(object.patches);
  LoadBudget::take(LoadWork::patches, mesh.triangles().size());
  auto out = std::make_shared<SurfacePatches>();
  out->in_file = mesh.names();
  const Friction* friction = object.effects.find<StickSlipFriction>();
  out->patches.push_back(
      {{}, {object.effects.of<SpringDamper>(), friction ? *friction : Friction{0.0, 0.0}}, 0});

  std::vector<std::uint16_t> patch_of_name(mesh.names().size() + 1, 0);
  for (std::size_t i = 0; i < mesh.names().size(); ++i) {
    const auto patch = std::ranges::find(object.patches, mesh.names()[i], &SurfacePatch::name);
    if (patch == object.patches.end()) continue;
    patch_of_name[i + 1] = static_cast<std::uint16_t>(out->patches.size());
    out->patches.push_back(planned(*patch));
  }
  out->of_triangle.reserve(mesh.triangles().size());
  for (std::size_t i = 0; i < mesh.triangles().size(); ++i) {
    const FaceNames names = mesh.face_names().empty() ? FaceNames{} : mesh.face_names()[i];
    const std::uint16_t material = patch_of_name[names.material];
    const std::uint16_t patch = material > 0 ? material : patch_of_name[names.group];
    out->of_triangle.push_back(patch);
    ++out->patches[patch].triangles;
  }
  for (const SurfacePatch& patch : object.patches) {
    const auto there = std::ranges::find(out->patches, patch.name, &PlannedPatch::name);
    if (there == out->patches.end() || there->triangles == 0) {
      static_cast<void>(planned(patch));  // only for its checks
      out->missing.push_back(patch.name);
    }
  }
  return out;
}

std::vector<std::string> patch_notes(const SurfacePatches& patches) {
  std::vector<std::string> notes;
  for (const std::string& name : patches.missing) {
    notes.push_back("patch \"" + name + "\" is not a material or group of any face; the file has " +
                    (patches.in_file.empty() ? "none: name them by usemtl or g in an OBJ, "
                                               "material_index in a PLY"
                                             : joined(patches.in_file)));
  }
  const std::size_t rest = patches.patches[0].triangles;
  if (rest > 0) {
    notes.push_back(std::to_string(rest) + " of " + std::to_string(patches.of_triangle.size()) +
                    " triangles " +
                    (rest == 1 ? "is in no patch and has" : "are in no patch and have") +
                    " the surface of the object");
  }
  return notes;
}

}  // namespace reckon::haptics
