// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Whence the groups of near rows of channels are listened to.
#pragma once

#include <cstddef>

#include "reckon/aoim/interest/channel_table.hpp"
#include "reckon/aoim/interest/subscription.hpp"

namespace reckon::aoim {

/// Groups for near rows are joined so long before a focus gets there [s]: a join takes up to 0.03,
/// and what is there is sent within 0.1 after that.
inline constexpr double kNearAhead = 0.3;
/// They are kept until the focus is farther than this times the row's end.
inline constexpr double kNearLeave = 1.1;

/// For a subscription to the groups of a near row.
[[nodiscard]] SubscriptionConfig near_subscription(SubscriptionConfig cells) noexcept;

/// From where a focus listens to a near row. Kept rows are said by the groups of the row behind
/// them, which so hold them, whatever the stretch.
/// @param row of those of the table that are not kept, the nearest being 0  @param focus whose
/// radius is that of what is sensed, or more where it stands for several
/// @param radius that is sensed [m]  @param stretch see ChannelTable::fit
[[nodiscard]] Focus near_focus(const ChannelTable& table, std::size_t row, const Focus& focus,
                               double radius, double stretch) noexcept;

}  // namespace reckon::aoim
