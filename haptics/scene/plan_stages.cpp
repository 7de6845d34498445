// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// EffectPlan::stages(): describes the stages of a plan.
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "reckon/haptics/geometry/implicit_solid.hpp"
#include "reckon/haptics/geometry/surface_mesh.hpp"
#include "reckon/haptics/scene/effect_plan.hpp"

namespace reckon::haptics {
namespace {

using MeshPointer = std::shared_ptr<const SurfaceMesh>;
using ImplicitPointer = std::shared_ptr<const ImplicitSolid>;

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

void append_value(std::string& text, std::string_view key, double value, std::string_view unit) {
  if (!text.empty()) text.append(", ");
  text.append(key).append(" ").append(number(value));
  if (!unit.empty()) text.append(" ").append(unit);
}

std::string file_text(const std::filesystem::path& file) {
  return file.empty() ? "no file" : "file \"" + file.filename().string() + '"';
}

template <class Effect>
PlanStage effect_stage(const std::string& object, const Effect& effect) {
  PlanStage stage{std::string(Effect::kName), object, {}, std::string(Effect::kCost)};
  if constexpr (TakesFile<Effect>) stage.parameters = file_text(effect.parameters().file);
  for (const auto& row : Effect::kParameters)
    append_value(stage.parameters, row.key, effect.parameters().*row.field, row.unit);
  // Four samples per wave render it fully.
  if constexpr (requires { effect.wavelength(); }) {
    append_value(stage.parameters, "waves of", effect.wavelength(), "m");
    append_value(stage.parameters, "whole up to", effect.wavelength() / 4e-3, "m/s at 1 kHz");
  }
  return stage;
}

template <class Guarded>
requires IsGuarded<Guarded> PlanStage effect_stage(const std::string& object,
                                                   const Guarded& guarded) {
  const CustomEffect& effect = guarded.effect();
  PlanStage stage{effect.name(), object, {}, effect.cost()};
  for (std::size_t i = 0; i < effect.parameters().size(); ++i) {
    const CustomParameter& row = effect.parameters()[i];
    append_value(stage.parameters, row.key, guarded.values()[i], row.unit);
  }
  return stage;
}

PlanStage contact_stage(const PlannedObject& object) {
  if (const auto* implicit = std::get_if<ImplicitPointer>(&object.shape)) {
    const std::size_t count = (*implicit)->function().leaves();
    return {"contact", object.name, (*implicit)->what(),
            count == 1 ? std::string("signed function")
                       : "linear in " + std::to_string(count) + " signed functions"};
  }
  const MeshPointer* mesh = std::get_if<MeshPointer>(&object.shape);
  if (mesh == nullptr) {
    constexpr const char* kNames[] = {"plane", "sphere", "box"};
    return {"contact", object.name, kNames[object.shape.index()], "closed form"};
  }
  const MeshReport& report = (*mesh)->report();
  return {"contact", object.name,
          (report.closed ? "closed mesh" : "open mesh, both sides felt") + std::string(", size ") +
              length_text((*mesh)->size()),
          "logarithmic in " + std::to_string(report.triangles) + " triangles"};
}

PlanStage region_stage(const PlannedRegion& region) {
  constexpr const char* kNames[] = {"everywhere", "below a plane", "in a sphere", "in a box"};
  return {"region", region.name, kNames[region.shape.index()], "a few multiplications"};
}

PlanStage patch_stage(const std::string& object, const PlannedPatch& patch, std::size_t id) {
  const Surface& surface = patch.feel.surface;
  const Friction& friction = patch.feel.friction;
  return {"patch", object,
          "\"" + patch.name + "\", number " + std::to_string(id) + ", stiffness " +
              number(surface.stiffness) + " N/m, damping " + number(surface.damping) +
              " N s/m, friction " + number(friction.static_coefficient) + " and " +
              number(friction.kinetic_coefficient),
          "two lags, where touched"};
}

}  // namespace

std::vector<PlanStage> EffectPlan::stages() const {
  std::vector<PlanStage> stages;
  for (const PlannedObject& object : objects_) {
    stages.push_back(contact_stage(object));
    for (std::size_t id = 1; object.patches && id < object.patches->patches.size(); ++id) {
      stages.push_back(patch_stage(object.name, object.patches->patches[id], id));
    }
    for (int turn = 0; turn < kTurns; ++turn) {
      object.effects.for_each([&](const auto& effect) {
        if (hooks_of(effect).turn() == turn) stages.push_back(effect_stage(object.name, effect));
      });
    }
  }
  for (const PlannedRegion& region : regions_) {
    stages.push_back(region_stage(region));
    region.effects.for_each([&]<class Effect>(const Effect& effect) {
      stages.push_back(effect_stage(region.name, effect));
    });
  }
  return stages;
}

}  // namespace reckon::haptics
