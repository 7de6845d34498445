// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reads the tables of effects by their own parameter tables. Private to the scene reader.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "reckon/haptics/effects/effect_declarations.hpp"
#include "reckon/haptics/effects/effect_guard.hpp"
#include "reckon/haptics/regions/region_guard.hpp"
#include "reckon/peer/scene/toml_reader.hpp"

namespace reckon::peer {

/// The parameters of an effect.
template <class Effect>
void read_parameters(TomlReader& owner, TomlReader& table, typename Effect::Parameters& values) {
  if constexpr (haptics::TakesFile<Effect>) table.read(Effect::kFile.key, values.file);
  for (const auto& row : Effect::kParameters) table.number(row.key, values.*row.field);
  try {
    const Effect checked(values);  // checks beyond single rows
  } catch (const std::invalid_argument& error) {
    owner.problem(Effect::kKey, error.what());
  }
}

/// Reads all of the program's effects that an object or a region declares.
/// @tparam Guarded tests one effect  @tparam Declared its kind and values
template <class Guarded, class Declared>
void read_custom_effects(TomlReader& owner, const std::string& name, std::vector<Declared>& out) {
  using Kind = typename decltype(Declared::effect)::element_type;
  for (const auto& any : owner.custom_effects()) {
    const auto effect = std::dynamic_pointer_cast<Kind>(any);
    auto table = effect ? owner.table(effect->key()) : std::nullopt;
    if (!table) continue;
    std::vector<double> values;
    for (const haptics::CustomParameter& row : effect->parameters())
      table->number(row.key, values.emplace_back(row.default_value));
    try {
      (void)Guarded({effect, values}, name);  // checks beyond single rows
    } catch (const std::invalid_argument& error) {
      owner.problem(effect->key(), error.what());
    }
    out.push_back({effect, std::move(values)});
  }
}

/// Reads all effects of a list that an object or region declares.
template <class Types>
void read_effects(TomlReader& owner, haptics::EffectDeclarations<Types>& effects) {
  haptics::for_each_effect<Types>([&]<class Effect>(std::type_identity<Effect>) {
    if (auto table = owner.table(Effect::kKey))
      read_parameters<Effect>(owner, *table, effects.template declare<Effect>());
  });
}

}  // namespace reckon::peer
