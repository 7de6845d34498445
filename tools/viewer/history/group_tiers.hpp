// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Which of a scene's groups carry what only some receive: near groups, of those who are near, and
// contact groups, of those within touch (docs/area_of_interest_mechanisms.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "reckon/peer/network/link.hpp"
#include "reckon/peer/scene/peer_config.hpp"

namespace reckon::tools {

/// What a group is for. `cell`: all else, the base group and foreign ones too.
enum class GroupTier : std::uint8_t { cell, near, contact };

struct TieredGroup {
  GroupTier tier = GroupTier::cell;
  std::uint16_t number = 0;  ///< of the group in its scene, from 1; 0 where tier is `cell`
};

/// Immutable. Without a scene it knows of no near and contact groups.
class GroupTiers {
 public:
  GroupTiers() = default;
  /// @throws std::invalid_argument where the groups of the scene cannot be
  GroupTiers(const peer::NetworkConfig& network, const peer::AoimConfig& aoim);

  /// Of an address. The port counts for nothing: a sealed exercise has another. Some ns.
  [[nodiscard]] TieredGroup of(peer::GroupAddress group) const noexcept;
  /// Whether the scene has any near or contact group.
  [[nodiscard]] bool any() const noexcept { return groups_.has_value(); }

 private:
  std::optional<peer::GroupPool> groups_;
  std::size_t cells_ = 0;    // groups of cells, the first ones
  std::size_t contact_ = 0;  // contact groups, the last ones
};

}  // namespace reckon::tools
