// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// [[region]]: a part of space in which effects act.
#include <fmt/format.h>

#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "reckon/haptics/regions/region_types.hpp"
#include "reckon/peer/scene/effect_reader.hpp"
#include "reckon/peer/scene/scene_sections.hpp"

namespace reckon::peer {
namespace {

using haptics::SceneRegion;

/// A member of the region's shape, set to kind S.
template <class S, class T>
auto of_region_shape(T S::*member) {
  return [member](auto& region) -> T& {
    if (!region.shape || !std::holds_alternative<S>(*region.shape)) region.shape = S{};
    return std::get<S>(*region.shape).*member;
  };
}

bool declares_any(const SceneRegion& region) {
  bool any = !region.custom_effects.empty();
  region.effects.for_each([&](const auto&) { any = true; });
  return any;
}

void check_region(TomlReader& table, SceneRegion& region) {
  table.require("name");
  const bool shaped = table.has("plane") || table.has("sphere") || table.has("box");
  if (shaped) (void)only_one(table, {"plane", "sphere", "box"}, "the shape");
  if (region.shape) {
    const auto* box = std::get_if<haptics::BoxShape>(&*region.shape);
    if (box != nullptr && box->size.minCoeff() <= 0)
      table.problem("box", "'box' has an edge that is not above 0 m");
    const auto* plane = std::get_if<haptics::PlaneShape>(&*region.shape);
    if (plane != nullptr && plane->normal.norm() < 1e-6)
      table.problem("plane",
                    "'plane' has no direction: write its outward normal, such as [0, 0, 1]");
  }
  region.pose.orientation = read_orientation(table);
  read_effects(table, region.effects);
  read_custom_effects<haptics::GuardedRegionEffect>(table, region.name, region.custom_effects);
  haptics::for_each_region_effect([&]<class Effect>(std::type_identity<Effect>) {
    if (haptics::ActsOutside<Effect> && !shaped && table.has(Effect::kKey))
      table.problem(Effect::kKey, fmt::format("a region without a shape has no {}: give it a shape",
                                              Effect::kKey));
  });
  if (!declares_any(region)) {
    std::vector<std::string_view> keys;
    haptics::for_each_region_effect(
        [&]<class Effect>(std::type_identity<Effect>) { keys.push_back(Effect::kKey); });
    for (const auto& effect : table.custom_effects())
      if (effect->section() == "region") keys.push_back(effect->key());
    table.problem(
        "name", fmt::format("this region has no effect: give it one of {}", fmt::join(keys, ", ")));
  }
}

}  // namespace

void read_regions(TomlReader& file, SceneFile& out) {
  const Section<SceneRegion> section = region_section();
  std::set<std::string> names;
  for (TomlReader& table : file.tables("region")) {
    SceneRegion& region = out.scene.regions.emplace_back();
    section.read(table, region);
    if (!region.name.empty() && !names.insert(region.name).second) {
      table.problem("name", fmt::format("there is another region '{}': rename one", region.name));
    }
  }
}

Section<SceneRegion> region_section() {
  const auto no_turn = [](const SceneRegion&) { return Eigen::Vector3d(0, 0, 0); };
  return {{
              {"name", &SceneRegion::name, "required; unique"},
              {"plane", of_region_shape(&haptics::PlaneShape::normal), declared("", -1e6, 1e6),
               "a half-space; its outward normal. A region without a shape is everywhere"},
              {"sphere", of_region_shape(&haptics::SphereShape::radius), declared("m", 1e-4, 1e3),
               "radius of a sphere"},
              {"box", of_region_shape(&haptics::BoxShape::size), declared("m", -1e3, 1e3),
               "edge lengths of a box about its centre"},
              {"position", in(&SceneRegion::pose, &haptics::ObjectPose::position),
               within("m", -kWorld, kWorld), "of its origin in S"},
              {"orientation", no_turn, within("rad", -4 * std::numbers::pi, 4 * std::numbers::pi),
               "rotations about S's x, then y, then z axis"},
          },
          check_region,
          add_region_effects};
}

}  // namespace reckon::peer
