// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/interest/near_rows.hpp"

#include <algorithm>

#include "reckon/pdu/seconds.hpp"

namespace reckon::aoim {

SubscriptionConfig near_subscription(SubscriptionConfig cells) noexcept {
  cells.leave_factor = kNearLeave;
  cells.lookahead = std::max(cells.lookahead, pdu::from_seconds(kNearAhead));
  cells.maximum_groups = kMaximumPool;
  return cells;
}

Focus near_focus(const ChannelTable& table, std::size_t row, const Focus& focus, double radius,
                 double stretch) noexcept {
  const std::size_t kept = table.kept_rows();
  double end = table.channel(kept + row).farthest / stretch;
  if (kept > 0) end = std::max(end, table.channel(kept - 1).farthest);
  Focus near = focus;
  near.radius = focus.radius < radius ? std::min(focus.radius, end)
                                      : focus.radius - radius + std::min(radius, end);
  return near;
}

}  // namespace reckon::aoim
