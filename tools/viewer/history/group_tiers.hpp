// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Finds the near groups and contact groups among a scene's groups; only entities near, or within
// touch, receive them (docs/area_of_interest_mechanisms.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "reckon/peer/network/link.hpp"
#include "reckon/peer/settings/aoim_config.hpp"
#include "reckon/peer/settings/network_config.hpp"

namespace reckon::tools {

/// Recipient tier of a group. `cell`: all other groups, including the base group and foreign ones.
enum class GroupTier : std::uint8_t { cell, near, contact };

struct TieredGroup {
  GroupTier tier = GroupTier::cell;
  std::uint16_t number = 0;  ///< number of the group in its scene, from 1; 0 if tier is `cell`
};

/// Immutable. Without a scene there are no near and contact groups.
class GroupTiers {
 public:
  GroupTiers() = default;
  /// @throws std::invalid_argument if the groups of the scene are invalid
  GroupTiers(const peer::NetworkConfig& network, const peer::AoimConfig& aoim) {
    if (network.interop || aoim.all_groups() <= aoim.pool) return;
    groups_.emplace(network.group, aoim.all_groups());
    cells_ = aoim.pool;
    contact_ = peer::has_touch_tier(aoim.tiers) ? aoim.pool : 0;
  }

  /// The tier of an address. Ignores the port, which differs in a sealed exercise. Some ns.
  [[nodiscard]] TieredGroup of(peer::GroupAddress group) const noexcept {
    if (!groups_) return {};
    group.port = groups_->base().port;
    const auto index = groups_->index(group);
    if (!index || *index < cells_) return {};
    const bool is_contact = *index >= groups_->size() - contact_;
    return {is_contact ? GroupTier::contact : GroupTier::near,
            static_cast<std::uint16_t>(*index + 1)};
  }
  /// Whether the scene has any near or contact group.
  [[nodiscard]] bool any() const noexcept { return groups_.has_value(); }

 private:
  std::optional<peer::GroupPool> groups_;
  std::size_t cells_ = 0;    // groups of cells, the first ones
  std::size_t contact_ = 0;  // contact groups, the last ones
};

}  // namespace reckon::tools
