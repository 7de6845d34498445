// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/tiers/tier_kind.hpp"

#include <algorithm>
#include <array>

#include "reckon/aoim/interest/near_rows.hpp"

namespace reckon::aoim {
namespace {

// A contact group is joined at a distance smaller by this factor than the one at which it is left.
constexpr double kContactLeave = 2.0;

Focus with_nimbus(const Focus& given, std::size_t, const TierReach& reach) noexcept {
  return {given.position, given.speed, given.radius + reach.farthest_nimbus, given.cut};
}

Focus to_end_of_row(const Focus& given, std::size_t row, const TierReach& reach) noexcept {
  return near_focus(*reach.rows, row, given, reach.radius, reach.stretch);
}

// A felt entity is never left out.
SubscriptionConfig contact_subscription(SubscriptionConfig cells) noexcept {
  cells.leave_factor = std::max(cells.leave_factor, kContactLeave);
  cells.maximum_groups = kMaximumPool;
  return cells;
}

}  // namespace

const TierKind kTouchKind{
    .name = "felt",
    .groups = "contact group",
    .is_urgent = true,
    .subscription = contact_subscription,
};

const TierKind kDistanceKind{
    .name = "near",
    .groups = "near group",
    .runs_ahead = true,
    .subscription = near_subscription,
    .focus = to_end_of_row,
};

const TierKind kCellKind{.focus = with_nimbus};

std::span<const TierKind* const> tier_kinds() noexcept {
  static constexpr std::array kKinds{&kTouchKind, &kDistanceKind, &kCellKind};
  return kKinds;
}

}  // namespace reckon::aoim
