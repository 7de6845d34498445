// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/scene/mechanisms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

#include "reckon/peer/scene/toml_reader.hpp"

namespace reckon::peer {
namespace {

using enum Condition;

constexpr std::array<std::string_view, 8> kWords{
    "experimental PDUs",          "more than one multicast group",
    "fixed groups for each cell", "Entity States in their plain form",
    "complete Entity States",     "the same updates for all receivers of a cell",
    "leaders of cells",           "a map of groups",
};

std::string_view words_of(Condition condition) {
  return kWords[static_cast<std::size_t>(condition)];
}

bool is_given(Condition condition) { return condition >= leaders; }

bool has(const std::vector<Condition>& conditions, Condition one) {
  return std::ranges::find(conditions, one) != conditions.end();
}

/// The first tier that satisfies `is`.
template <class Is>
std::size_t first_tier(const SceneFile& scene, Is is) {
  const Tiers& tiers = scene.aoim.tiers;
  return static_cast<std::size_t>(std::ranges::find_if(tiers, is) - tiers.begin());
}

const std::vector<Mechanism> kMechanisms{
    {"network",
     "interop",
     [](const SceneFile& scene) { return scene.network.interop; },
     {},
     {own_datagrams, many_groups},
     {}},
    {"network",
     "compression",
     [](const SceneFile& scene) {
       return scene.network.compression == pdu::CompressedForm::compact;
     },
     {own_datagrams},
     {plain_states},
     {}},
    {"network",
     "compression",
     [](const SceneFile& scene) {
       return scene.network.compression == pdu::CompressedForm::residual;
     },
     {own_datagrams, one_stream},
     {plain_states},
     {}},
    {"network",
     "key",
     [](const SceneFile& scene) { return !scene.network.key.empty(); },
     {own_datagrams},
     {},
     {}},
    {"aoim",
     "leaders",
     [](const SceneFile& scene) { return scene.aoim.leaders; },
     {own_datagrams, plain_states, whole_states},
     {},
     {leaders}},
    {"aoim",
     "hand_out",
     [](const SceneFile& scene) { return scene.aoim.hand_out; },
     {leaders},
     {fixed_groups},
     {group_map}},
    {"aoim",
     "follow",
     [](const SceneFile& scene) { return !scene.aoim.follow.empty(); },
     {group_map},
     {},
     {}},
    {"aoim",
     "budget",
     [](const SceneFile& scene) { return scene.aoim.awareness.budget > 0.0; },
     {own_datagrams, many_groups},
     {},
     {}},
    {"aoim",
     "tier",
     [](const SceneFile& scene) { return has_touch_tier(scene.aoim.tiers); },
     {many_groups, fixed_groups},
     {},
     {},
     "to = \"touch\"",
     [](const SceneFile& scene) {
       return first_tier(scene, [](const TierConfig& tier) { return !is_by_distance(tier); });
     }},
    {"aoim",
     "tier",
     [](const SceneFile& scene) { return has_distance_tiers(scene.aoim.tiers); },
     {},
     {whole_states},
     {},
     "to = \"distance\"",
     [](const SceneFile& scene) { return first_tier(scene, is_by_distance); }},
    {"aoim",
     "tier",
     [](const SceneFile& scene) { return own_group_count(scene.aoim.tiers) > 0; },
     {many_groups, fixed_groups},
     {one_stream},
     {},
     "own_group = true",
     [](const SceneFile& scene) { return first_tier(scene, &TierConfig::own_group); }},
    {"aoim",
     "scheme",
     [](const SceneFile& scene) { return scene.aoim.scheme == aoim::CellScheme::locales; },
     {many_groups},
     {},
     {}},
};

/// "'leaders'", "'tier' with own_group = true".
std::string name_of(const Mechanism& one) {
  return fmt::format("'{}'{}{}", one.key, one.value.empty() ? "" : " with ", one.value);
}

/// The path in a file that switches it on, for TomlReader::problem_at.
std::string path_of(const Mechanism& one, const SceneFile& scene) {
  const std::string path = fmt::format("{}.{}", one.table, one.key);
  return one.row == nullptr ? path : fmt::format("{}[{}]", path, one.row(scene));
}

}  // namespace

std::span<const Mechanism> mechanisms() { return kMechanisms; }

void check_mechanisms(TomlReader& file, const SceneFile& scene) {
  const auto is_on = [&](const Mechanism& one) { return one.is_on(scene); };
  for (const Mechanism& one : mechanisms()) {
    if (!is_on(one)) continue;
    for (const Condition need : one.needs) {
      if (is_given(need)) {
        const auto gives = [&](const Mechanism& other) { return has(other.gives, need); };
        if (std::ranges::any_of(mechanisms(),
                                [&](const auto& other) { return gives(other) && is_on(other); }))
          continue;
        const auto giver = std::ranges::find_if(mechanisms(), gives);
        file.problem_at(path_of(one, scene),
                        fmt::format("{} needs {}: set {} too, or remove {}", name_of(one),
                                    words_of(need), name_of(*giver), name_of(one)));
        continue;
      }
      for (const Mechanism& other : mechanisms()) {
        if (!is_on(other) || !has(other.takes, need)) continue;
        file.problem_at(path_of(one, scene),
                        fmt::format("{} needs {}, which {} excludes: remove one of the two",
                                    name_of(one), words_of(need), name_of(other)));
      }
    }
  }
}

}  // namespace reckon::peer
