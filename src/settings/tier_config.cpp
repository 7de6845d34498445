// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/settings/tier_config.hpp"

#include <algorithm>

namespace reckon::peer {

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

}  // namespace reckon::peer
