// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/scene/scene_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "reckon/haptics/effects/effect_types.hpp"
#include "reckon/haptics/regions/region_types.hpp"
#include "reckon/peer/scene/scene_sections.hpp"

namespace reckon::peer {
namespace {

using Keys = std::vector<SceneKey>;

SceneKey table(std::string section, std::string key, std::string sentence) {
  return {std::move(section), std::move(key), KeyKind::table, "", 0, 0, "", std::move(sentence)};
}

SceneKey number(std::string section, std::string key, std::string unit, double least, double most,
                std::string standard, std::string sentence) {
  return {std::move(section),  std::move(key),     KeyKind::number, std::move(unit), least, most,
          std::move(standard), std::move(sentence)};
}

/// Formats "Higher sticks longer." like the other rows.
std::string as_row(std::string_view sentence) {
  std::string row(sentence);
  if (row.ends_with('.')) row.pop_back();
  const bool acronym = row.size() > 1 && std::isupper(static_cast<unsigned char>(row[1])) != 0;
  if (!row.empty() && !acronym)
    row[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(row[0])));
  return row;
}

}  // namespace

namespace {

template <class Effect>
void add_effect_table(Keys& keys, const std::string& section) {
  keys.push_back(table(section, std::string(Effect::kKey),
                       fmt::format("the effect {}; costs {}", Effect::kName, Effect::kCost)));
}

/// @param standard whether a default applies if a key is absent
template <class Effect>
void add_effect_keys(Keys& keys, const std::string& section, bool standard) {
  if constexpr (haptics::TakesFile<Effect>)
    keys.push_back({section + "." + std::string(Effect::kKey), std::string(Effect::kFile.key),
                    KeyKind::text, "", 0, 0, "", as_row(Effect::kFile.help)});
  for (const auto& row : Effect::kParameters) {
    keys.push_back(number(section + "." + std::string(Effect::kKey), std::string(row.key),
                          std::string(row.unit), row.minimum, row.maximum,
                          standard ? format_quantity(row.default_value, row.unit) : "",
                          as_row(row.help)));
  }
}

}  // namespace

void add_effects(Keys& keys) {
  haptics::for_each_effect(
      [&]<class Effect>(std::type_identity<Effect>) { add_effect_table<Effect>(keys, "object"); });
  haptics::for_each_effect([&]<class Effect>(std::type_identity<Effect>) {
    add_effect_keys<Effect>(keys, "object", true);
  });
}

void add_region_effects(Keys& keys) {
  haptics::for_each_region_effect(
      [&]<class Effect>(std::type_identity<Effect>) { add_effect_table<Effect>(keys, "region"); });
  haptics::for_each_region_effect([&]<class Effect>(std::type_identity<Effect>) {
    add_effect_keys<Effect>(keys, "region", true);
  });
}

void add_custom_effects(const haptics::CustomEffects& effects, Keys& keys) {
  for (const auto& effect : effects) {
    const bool taken = std::ranges::any_of(keys, [&](const SceneKey& key) {
      return key.section == effect->section() && key.key == effect->key();
    });
    if (taken)
      throw std::invalid_argument(
          fmt::format("the key '{}' of the effect {} is in use: give it another kKey",
                      effect->key(), effect->name()));
    const std::string section(effect->section());
    keys.push_back(table(section, effect->key(),
                         fmt::format("the effect {}; costs {}", effect->name(), effect->cost())));
    for (const haptics::CustomParameter& row : effect->parameters())
      keys.push_back(number(section + "." + effect->key(), row.key, row.unit, row.minimum,
                            row.maximum, format_quantity(row.default_value, row.unit),
                            as_row(row.help)));
  }
}

void add_patch_effects(Keys& keys) {
  add_effect_table<haptics::SpringDamper>(keys, "patch");
  add_effect_table<haptics::StickSlipFriction>(keys, "patch");
  add_effect_keys<haptics::SpringDamper>(keys, "patch", false);
  add_effect_keys<haptics::StickSlipFriction>(keys, "patch", false);
}

namespace {

/// "1 mm to 1 m", or nothing if there is no range to state.
std::string range_of(const SceneKey& key) {
  if (key.kind == KeyKind::integer || (key.kind == KeyKind::choice && key.most > 0))
    return fmt::format("{:.0f} to {:.0f}", key.least, key.most);
  if (key.kind != KeyKind::number) return {};
  return fmt::format("{} to {}", format_quantity(key.least, key.unit),
                     format_quantity(key.most, key.unit));
}

}  // namespace

const std::vector<SceneKey>& scene_keys() {
  static const Keys keys = file_section().keys("");
  return keys;
}

std::string section_name(std::string_view section) {
  if (section.empty()) return "the file";
  const bool repeated = std::ranges::any_of(scene_keys(), [&](const SceneKey& key) {
    return key.kind == KeyKind::tables &&
           (key.section.empty() ? key.key : key.section + '.' + key.key) == section;
  });
  return fmt::format(fmt::runtime(repeated ? "[[{}]]" : "[{}]"), section);
}

std::string describe_kind(const SceneKey& key) {
  switch (key.kind) {
    case KeyKind::number:
      if (key.unit.empty()) return "number";
      return fmt::format(
          "number [{}]{}", key.unit,
          key.share_of.empty() ? "" : fmt::format(", or share of `{}`", key.share_of));
    case KeyKind::integer:
      return "whole number";
    case KeyKind::boolean:
      return "true or false";
    case KeyKind::text:
      return "text";
    case KeyKind::texts:
      return "texts, any number";
    case KeyKind::choice:
      return fmt::format("one of {}{}", fmt::join(key.words, " "),
                         key.most > 0 ? ", or a whole number" : "");
    case KeyKind::point:
      return key.unit.empty() ? "three numbers" : fmt::format("three numbers [{}]", key.unit);
    case KeyKind::table:
      return "table";
    case KeyKind::tables:
      break;
  }
  return "tables, any number";
}

std::string scene_keys_markdown() { return "### The file\n\n" + keys_markdown(scene_keys()); }

std::string keys_markdown(const Keys& keys) {
  std::string text;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const SceneKey& key = keys[i];
    if (i > 0 && keys[i - 1].section != key.section) {
      text += fmt::format("\n### `{}`\n\n", section_name(key.section));
    }
    if (i == 0 || keys[i - 1].section != key.section) {
      text += "| key | value | range | default | meaning |\n|---|---|---|---|---|\n";
    }
    text += fmt::format("| `{}` | {} | {} | {} | {} |\n", key.key, describe_kind(key),
                        range_of(key), key.standard, key.sentence);
  }
  return text;
}

}  // namespace reckon::peer
