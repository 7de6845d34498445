// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The recipient tiers of a scene: the recipients of an update, its rate and its accuracy.
#pragma once

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
[[nodiscard]] bool has_touch_tier(const Tiers& tiers) noexcept;
[[nodiscard]] bool has_distance_tiers(const Tiers& tiers) noexcept;
/// The rows by distance, the nearest first.
[[nodiscard]] std::vector<aoim::Channel> channels_of(const Tiers& tiers);
/// Reason why the tier at this index cannot have its own group; empty if it can.
[[nodiscard]] std::string own_group_refusal(const Tiers& tiers, std::size_t place);
/// Whether each cell has a separate group for it.
[[nodiscard]] constexpr bool has_group(const TierConfig& tier) noexcept {
  return tier.own_group || !is_by_distance(tier);
}
/// Tiers for which each cell has a separate group.
[[nodiscard]] std::size_t group_tier_count(const Tiers& tiers) noexcept;
/// Number of these tiers that are by distance.
[[nodiscard]] std::size_t own_group_count(const Tiers& tiers) noexcept;

/// Tiers by distance from these rows.
/// @param own_groups whether each tier that can have its own group has one
[[nodiscard]] Tiers distance_tiers(std::span<const aoim::Channel> rows, bool own_groups = false);

}  // namespace reckon::peer
