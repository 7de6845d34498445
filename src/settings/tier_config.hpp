// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The recipient tiers of a scene: the recipients of an update, its rate and its accuracy.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "reckon/aoim/interest/channel_table.hpp"

namespace reckon::peer {

/// Condition for receiving an entity's updates.
enum class Recipients : std::uint8_t {
  touch,    ///< it can touch the entity: felt updates use a separate group of each cell
  distance  ///< it is within a distance of the entity
};

/// One row of [[aoim.tier]].
struct TierConfig {
  Recipients to = Recipients::distance;
  aoim::Channel channel;   ///< of a tier by distance
  bool own_group = false;  ///< of a tier by distance: it has a separate group of each cell
};

/// The tiers of a scene, innermost first: at most one by touch, which is the first, then the ones
/// by distance. None: all peers receive everything. For set-up: the functions below may allocate.
using Tiers = std::vector<TierConfig>;

/// Whether its recipients have a greatest distance, a rate and an accuracy.
[[nodiscard]] constexpr bool is_by_distance(const TierConfig& tier) noexcept {
  return tier.to != Recipients::touch;
}
[[nodiscard]] inline bool has_touch_tier(const Tiers& tiers) noexcept {
  return !std::ranges::all_of(tiers, is_by_distance);
}
[[nodiscard]] inline bool has_distance_tiers(const Tiers& tiers) noexcept {
  return std::ranges::any_of(tiers, is_by_distance);
}
/// The rows by distance, the nearest first.
[[nodiscard]] inline std::vector<aoim::Channel> channels_of(const Tiers& tiers) {
  std::vector<aoim::Channel> rows;
  for (const TierConfig& tier : tiers) {
    if (is_by_distance(tier)) rows.push_back(tier.channel);
  }
  return rows;
}
/// Reason why the tier at this index cannot have its own group; empty if it can.
[[nodiscard]] inline std::string own_group_refusal(const Tiers& tiers, std::size_t place) {
  if (place + 1 == tiers.size()) return "the last tier uses the group of the cell";
  if (tiers[place].channel.kept) return "a tier that is 'kept' uses the group of the next one";
  return {};
}
/// Whether each cell has a separate group for it.
[[nodiscard]] constexpr bool has_group(const TierConfig& tier) noexcept {
  return tier.own_group || !is_by_distance(tier);
}
/// Tiers for which each cell has a separate group.
[[nodiscard]] inline std::size_t group_tier_count(const Tiers& tiers) noexcept {
  return static_cast<std::size_t>(std::ranges::count_if(tiers, has_group));
}
/// Number of these tiers that are by distance.
[[nodiscard]] inline std::size_t own_group_count(const Tiers& tiers) noexcept {
  return static_cast<std::size_t>(std::ranges::count(tiers, true, &TierConfig::own_group));
}

/// Tiers by distance from these rows.
/// @param own_groups whether each tier that can have its own group has one
[[nodiscard]] inline Tiers distance_tiers(std::span<const aoim::Channel> rows,
                                          bool own_groups = false) {
  Tiers tiers;
  for (const aoim::Channel& row : rows) tiers.push_back({Recipients::distance, row, false});
  for (std::size_t place = 0; own_groups && place < tiers.size(); ++place)
    tiers[place].own_group = own_group_refusal(tiers, place).empty();
  return tiers;
}

}  // namespace reckon::peer
