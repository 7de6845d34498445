// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/scene/renamed_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <sstream>
#include <utility>
#include <vector>

#include "reckon/peer/scene/scene_sections.hpp"
#include "reckon/peer/settings/tier_config.hpp"

namespace reckon::peer {
namespace {

bool is_on(const toml::table& table, std::string_view key) { return table[key].value_or(false); }

std::string value_text(const toml::node& value) {
  constexpr auto kFlags =
      toml::toml_formatter::default_flags & ~toml::format_flags::allow_literal_strings;
  std::ostringstream text;
  text << toml::toml_formatter(value, kFlags);
  return text.str();
}

/// The lines of a table, in the order of its file.
std::string lines_of(const toml::table& table) {
  std::vector<std::pair<toml::source_position, std::string>> lines;
  for (const auto& [key, value] : table)
    lines.emplace_back(key.source().begin, fmt::format("{} = {}\n", key.str(), value_text(value)));
  std::ranges::stable_sort(lines, [](const auto& a, const auto& b) { return a.first < b.first; });
  std::string text;
  for (const auto& line : lines) text += line.second;
  return text;
}

/// Converts the rows of [[aoim.channel]] to rows of [[aoim.tier]].
std::string channel_rows(const toml::table& aoim) {
  const toml::array* rows = aoim["channel"].as_array();
  std::string text;
  for (std::size_t i = 0; rows != nullptr && i < rows->size(); ++i) {
    const toml::table* row = rows->get(i)->as_table();
    if (row == nullptr) continue;
    text += "[[aoim.tier]]\n" + lines_of(*row);
    if (is_on(aoim, "near_groups") && i + 1 < rows->size() && !is_on(*row, "kept"))
      text += "own_group = true\n";
  }
  return text;
}

/// "write, behind the other keys of [aoim]:" and these rows, without the last line end.
std::string instead(std::string_view old, std::string_view where, std::string rows) {
  while (rows.ends_with('\n')) rows.pop_back();
  return fmt::format("{}: {}:\n{}", old, where, rows);
}

constexpr std::string_view kBehind = "remove the line and write, after the other keys of [aoim]";
constexpr std::string_view kTakeOut = "remove the line";

std::string of_channels(const toml::table& aoim) {
  if (aoim.contains("channel") || !is_on(aoim, "channels"))
    return fmt::format("'channels' was replaced by rows of [[aoim.tier]]: {}", kTakeOut);
  return instead("'channels' is now rows of [[aoim.tier]]", kBehind,
                 tiers_text(distance_tiers(aoim::default_channels(), is_on(aoim, "near_groups"))));
}

std::string of_channel(const toml::table& aoim) {
  return instead("'channel' is 'tier' now", "write in place of all its rows", channel_rows(aoim));
}

std::string of_contact_groups(const toml::table& aoim) {
  constexpr std::string_view kNow = "'contact_groups' is now a tier";
  if (!is_on(aoim, "contact_groups")) return fmt::format("{}: {}", kNow, kTakeOut);
  return instead(kNow, fmt::format("{}, before any other [[aoim.tier]]", kBehind),
                 tiers_text({{Recipients::touch, {}, false}}));
}

std::string of_near_groups(const toml::table& aoim) {
  constexpr std::string_view kNow = "'near_groups' is now a key of tiers";
  if (!is_on(aoim, "near_groups")) return fmt::format("{}: {}", kNow, kTakeOut);
  return instead(kNow,
                 "remove the line and write in each [[aoim.tier]] by distance that is neither "
                 "'kept' nor the last",
                 "own_group = true");
}

constexpr std::array kRenamed{
    RenamedKey{"aoim", "channels", of_channels},
    RenamedKey{"aoim", "channel", of_channel},
    RenamedKey{"aoim", "contact_groups", of_contact_groups},
    RenamedKey{"aoim", "near_groups", of_near_groups},
};

}  // namespace

std::span<const RenamedKey> renamed_keys() { return kRenamed; }

}  // namespace reckon::peer
