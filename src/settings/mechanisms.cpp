// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/settings/mechanisms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>

namespace reckon::peer {
namespace {

using enum Condition;

constexpr std::array<std::string_view, 8> kConditions{
    "experimental PDUs",          "more than one multicast group",
    "fixed groups for each cell", "Entity States in their plain form",
    "complete Entity States",     "the same updates for all receivers of a cell",
    "leaders of cells",           "a map of groups",
};

std::string_view words_of(Condition condition) {
  return kConditions[static_cast<std::size_t>(condition)];
}

bool is_given(Condition condition) { return condition >= leaders; }

bool has(const std::vector<Condition>& conditions, Condition one) {
  return std::ranges::find(conditions, one) != conditions.end();
}

/// The first tier that satisfies `is`.
std::size_t first_tier(const Switches& settings, auto is) {
  const Tiers& tiers = settings.aoim.tiers;
  return static_cast<std::size_t>(std::ranges::find_if(tiers, is) - tiers.begin());
}

const std::vector<Mechanism> kMechanisms{
    {"network",
     "interop",
     [](const Switches& settings) { return settings.network.interop; },
     {},
     {own_datagrams, many_groups},
     {}},
    {"network",
     "compression",
     [](const Switches& settings) {
       return settings.network.compression == pdu::CompressedForm::compact;
     },
     {own_datagrams},
     {plain_states},
     {}},
    {"network",
     "compression",
     [](const Switches& settings) {
       return settings.network.compression == pdu::CompressedForm::residual;
     },
     {own_datagrams, one_stream},
     {plain_states},
     {}},
    {"network",
     "key",
     [](const Switches& settings) { return !settings.network.key.empty(); },
     {own_datagrams},
     {},
     {}},
    {"aoim",
     "leaders",
     [](const Switches& settings) { return settings.aoim.leaders; },
     {own_datagrams, plain_states, whole_states},
     {},
     {leaders}},
    {"aoim",
     "hand_out",
     [](const Switches& settings) { return settings.aoim.hand_out; },
     {leaders},
     {fixed_groups},
     {group_map}},
    {"aoim",
     "follow",
     [](const Switches& settings) { return !settings.aoim.follow.empty(); },
     {group_map},
     {},
     {}},
    {"aoim",
     "budget",
     [](const Switches& settings) { return settings.aoim.awareness.budget > 0.0; },
     {own_datagrams, many_groups},
     {},
     {}},
    {"aoim",
     "tier",
     [](const Switches& settings) { return has_touch_tier(settings.aoim.tiers); },
     {many_groups, fixed_groups},
     {},
     {},
     "to = \"touch\"",
     [](const Switches& settings) {
       return first_tier(settings, [](const TierConfig& tier) { return !is_by_distance(tier); });
     }},
    {"aoim",
     "tier",
     [](const Switches& settings) { return has_distance_tiers(settings.aoim.tiers); },
     {},
     {whole_states},
     {},
     "to = \"distance\"",
     [](const Switches& settings) { return first_tier(settings, is_by_distance); }},
    {"aoim",
     "tier",
     [](const Switches& settings) { return own_group_count(settings.aoim.tiers) > 0; },
     {many_groups, fixed_groups},
     {one_stream},
     {},
     "own_group = true",
     [](const Switches& settings) { return first_tier(settings, &TierConfig::own_group); }},
    {"aoim",
     "scheme",
     [](const Switches& settings) { return settings.aoim.scheme == aoim::CellScheme::locales; },
     {many_groups},
     {},
     {}},
};

/// "'leaders'", "'tier' with own_group = true".
std::string name_of(const Mechanism& one) {
  return fmt::format("'{}'{}{}", one.key, one.value.empty() ? "" : " with ", one.value);
}

/// The path in a scene file that switches it on.
std::string path_of(const Mechanism& one, const Switches& settings) {
  const std::string path = fmt::format("{}.{}", one.table, one.key);
  return one.row == nullptr ? path : fmt::format("{}[{}]", path, one.row(settings));
}

}  // namespace

std::span<const Mechanism> mechanisms() { return kMechanisms; }

std::vector<UnmetCondition> unmet_conditions(const Switches& settings) {
  const auto is_on = [&](const Mechanism& one) { return one.is_on(settings); };
  std::vector<UnmetCondition> unmet;
  const auto report = [&](const Mechanism& one, std::string sentence) {
    unmet.push_back({path_of(one, settings), std::move(sentence)});
  };
  for (const Mechanism& one : mechanisms()) {
    if (!is_on(one)) continue;
    for (const Condition need : one.needs) {
      if (is_given(need)) {
        const auto gives = [&](const Mechanism& other) { return has(other.gives, need); };
        if (std::ranges::any_of(mechanisms(),
                                [&](const auto& other) { return gives(other) && is_on(other); }))
          continue;
        const auto giver = std::ranges::find_if(mechanisms(), gives);
        report(one, fmt::format("{} needs {}: set {} too, or remove {}", name_of(one),
                                words_of(need), name_of(*giver), name_of(one)));
        continue;
      }
      for (const Mechanism& other : mechanisms()) {
        if (!is_on(other) || !has(other.takes, need)) continue;
        report(one, fmt::format("{} needs {}, which {} excludes: remove one of the two",
                                name_of(one), words_of(need), name_of(other)));
      }
    }
  }
  return unmet;
}

}  // namespace reckon::peer
