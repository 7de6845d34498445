// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/scene/tier_config.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "reckon/peer/notation/units.hpp"
#include "reckon/peer/scene/scene_words.hpp"

namespace reckon::peer {
namespace {

std::string tier_text(const TierConfig& tier) {
  std::string text = "[[aoim.tier]]\n";
  const auto say = [&](std::string_view key, const std::string& value) {
    text += fmt::format("{} = {}\n", key, value);
  };
  const auto quantity = [&](std::string_view key, double value, std::string_view unit) {
    say(key, fmt::format("\"{}\"", format_quantity(value, unit)));
  };
  if (!is_by_distance(tier)) {
    say("to", "\"touch\"");
    return text;
  }
  const aoim::Channel& row = tier.channel;
  if (std::isfinite(row.farthest)) quantity("farthest", row.farthest, "m");
  if (row.body != aoim::Channel{}.body) say("body", fmt::format("\"{}\"", word_of(row.body)));
  quantity("active", row.active_hz, "Hz");
  quantity("passive", row.passive_hz, "Hz");
  quantity("octets", row.octets, "B");
  if (row.kept) say("kept", "true");
  if (row.coarser != 1.0) say("coarser", fmt::format("{:.9g}", row.coarser));
  if (tier.own_group) say("own_group", "true");
  return text;
}

}  // namespace

bool has_touch_tier(const Tiers& tiers) noexcept {
  return !std::ranges::all_of(tiers, is_by_distance);
}

bool has_distance_tiers(const Tiers& tiers) noexcept {
  return std::ranges::any_of(tiers, is_by_distance);
}

std::vector<aoim::Channel> channels_of(const Tiers& tiers) {
  std::vector<aoim::Channel> rows;
  for (const TierConfig& tier : tiers) {
    if (is_by_distance(tier)) rows.push_back(tier.channel);
  }
  return rows;
}

std::string own_group_refusal(const Tiers& tiers, std::size_t place) {
  if (place + 1 == tiers.size()) return "the last tier uses the group of the cell";
  if (tiers[place].channel.kept) return "a tier that is 'kept' uses the group of the next one";
  return {};
}

std::size_t group_tier_count(const Tiers& tiers) noexcept {
  return static_cast<std::size_t>(std::ranges::count_if(tiers, has_group));
}

std::size_t own_group_count(const Tiers& tiers) noexcept {
  return static_cast<std::size_t>(std::ranges::count(tiers, true, &TierConfig::own_group));
}

Tiers distance_tiers(std::span<const aoim::Channel> rows, bool own_groups) {
  Tiers tiers;
  for (const aoim::Channel& row : rows) tiers.push_back({Recipients::distance, row, false});
  for (std::size_t place = 0; own_groups && place < tiers.size(); ++place)
    tiers[place].own_group = own_group_refusal(tiers, place).empty();
  return tiers;
}

std::string tiers_text(const Tiers& tiers) {
  std::string text;
  for (const TierConfig& tier : tiers) text += tier_text(tier);
  return text;
}

}  // namespace reckon::peer
