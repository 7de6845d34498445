// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The recipient tiers of a scene: who receives an update, how often and how well.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "reckon/aoim/interest/channel_table.hpp"

namespace reckon::peer {

/// What makes a peer a recipient of an entity's updates.
enum class Recipients : std::uint8_t {
  touch,    ///< it can touch the entity: what is felt goes by a group of its own of each cell
  distance  ///< it is within a distance of the entity
};

/// One row of [[aoim.tier]].
struct TierConfig {
  Recipients to = Recipients::distance;
  aoim::Channel channel;   ///< of a tier by distance
  bool own_group = false;  ///< of a tier by distance: it has a group of its own of each cell
};

/// The tiers of a scene, inmost first: at most one of touch, which is the first, then those by
/// distance. None: everything goes to all. For set-up: the functions below may allocate.
using Tiers = std::vector<TierConfig>;

[[nodiscard]] bool has_touch_tier(const Tiers& tiers) noexcept;
[[nodiscard]] bool has_distance_tiers(const Tiers& tiers) noexcept;
/// The rows by distance, the nearest first.
[[nodiscard]] std::vector<aoim::Channel> channels_of(const Tiers& tiers);
/// Why the tier at this place can have no group of its own; empty where it can have one.
[[nodiscard]] std::string own_group_refusal(const Tiers& tiers, std::size_t place);
/// Tiers by distance that have groups of their own.
[[nodiscard]] std::size_t own_group_count(const Tiers& tiers) noexcept;

/// Tiers by distance of these rows.
/// @param own_groups whether those that can have one have a group of their own
[[nodiscard]] Tiers distance_tiers(std::span<const aoim::Channel> rows, bool own_groups = false);

/// The rows of [[aoim.tier]] that say these tiers, each line with its end.
[[nodiscard]] std::string tiers_text(const Tiers& tiers);

}  // namespace reckon::peer
