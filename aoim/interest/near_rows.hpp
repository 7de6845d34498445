// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Selects the near groups that a peer joins. A row of the channel table with its own recipient tier
// is a near row. In each cell it has a multicast group, its near group, for the peers whose
// entities are closer than the row's distance.
#pragma once

#include <algorithm>
#include <cstddef>

#include "reckon/aoim/interest/channel_table.hpp"
#include "reckon/aoim/interest/subscription.hpp"
#include "reckon/pdu/seconds.hpp"

namespace reckon::aoim {

/// A near group is joined this long [s] before an entity of this peer can be within the row's
/// distance of the group's cell: a join takes up to 0.03 s, and owners send the states of their
/// entities there within 0.1 s after that.
inline constexpr double kNearAhead = 0.3;
/// It is left when the cell is farther away than this factor times the row's distance.
inline constexpr double kNearLeave = 1.1;

/// Settings of the subscription to near groups: the settings for cells, with the two values above
/// and without a cap on the groups.
[[nodiscard]] inline SubscriptionConfig near_subscription(SubscriptionConfig cells) noexcept {
  cells.leave_factor = kNearLeave;
  cells.lookahead = std::max(cells.lookahead, pdu::from_seconds(kNearAhead));
  cells.maximum_groups = kMaximumPool;
  return cells;
}

/// The ball around an own entity that decides which near groups of one row are joined: the groups
/// of the cells that it reaches. Its radius is the distance at which the row ends, divided by the
/// stretch, and at most the sensing radius. Rows that are kept (Channel::kept) have no near groups:
/// their updates go to the near groups of the first row that is not kept. So the radius is at least
/// the distance at which the kept rows end, which no stretch shortens.
/// @param row number of the near row: 0 is the first row that is not kept
/// @param focus focus of the subscription to cell groups. Its radius is the sensing radius, or more
/// if it represents several entities: the excess is added to the row's radius. A smaller radius is
/// the limit.
/// @param radius at which an entity senses others [m]
/// @param stretch factor on distances that meets the receiver's budget, see ChannelTable::fit
[[nodiscard]] inline Focus near_focus(const ChannelTable& table, std::size_t row,
                                      const Focus& focus, double radius, double stretch) noexcept {
  const std::size_t kept = table.kept_rows();
  double end = table.channel(kept + row).farthest / stretch;
  if (kept > 0) end = std::max(end, table.channel(kept - 1).farthest);
  Focus near = focus;
  near.radius = focus.radius < radius ? std::min(focus.radius, end)
                                      : focus.radius - radius + std::min(radius, end);
  return near;
}

}  // namespace reckon::aoim
