// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The kinds of recipient tiers, and how a tier of each kind differs from the others. THE list is in
// tier_kind.cpp.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "reckon/aoim/interest/channel_table.hpp"
#include "reckon/aoim/interest/subscription.hpp"

namespace reckon::aoim {

/// Determines the distance around a focus within which the groups of a tier are joined.
struct TierReach {
  double radius = 0.0;               ///< range in which entities sense [m], >= 0
  double farthest_nimbus = 0.0;      ///< [m], >= 0: cells are joined this much farther
  std::optional<ChannelTable> rows;  ///< of channels; needed only for tiers that run ahead
  double stretch = 1.0;  ///< factor of the rows on distances, > 0; see ChannelTable::fit
};

/// A kind of recipients. Each tier except the cell's is urgent or runs ahead.
struct TierKind {
  std::string_view name = {};    ///< of its updates, in names of counters
  std::string_view groups = {};  ///< one of its groups, in words
  /// Its updates are sent at once, in plain form and with all records, and are read before the
  /// updates of other tiers. It shares the nearest row of channels, and outer tiers get a new state
  /// soon after.
  bool is_urgent = false;
  /// Its tiers have a row of channels each, whose thresholds are finer than those of outer tiers.
  /// Outer tiers therefore lack its updates for a time without bound: a new listener requests the
  /// present states, a listener that leaves falls back to the states of the outer tiers, and
  /// leaders, which relay the cell's updates, are excluded.
  bool runs_ahead = false;
  /// The subscription to its groups, derived from the subscription to the cells; null: the same.
  SubscriptionConfig (*subscription)(SubscriptionConfig cells) noexcept = nullptr;
  /// The focus from which its groups are subscribed to; null: the given one.
  /// @param row of channels of the tier, see TierTable::row_of
  Focus (*focus)(const Focus& given, std::size_t row, const TierReach& reach) noexcept = nullptr;
};

/// All listeners of the cell. Foci: the sensing ranges of our entities.
extern const TierKind kCellKind;
/// Listeners within the distance of a row of channels that is neither kept nor the last. The same
/// foci.
extern const TierKind kDistanceKind;
/// Listeners that can touch the entity. Foci: positions of our touchable entities, with their
/// reach. A group is kept until its cell is beyond twice the reach, and at least as long as any
/// other.
extern const TierKind kTouchKind;

/// THE list, the innermost first.
[[nodiscard]] std::span<const TierKind* const> tier_kinds() noexcept;

}  // namespace reckon::aoim
