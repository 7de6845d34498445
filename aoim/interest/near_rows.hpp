// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Subscription to the groups of near rows of channels.
#pragma once

#include <cstddef>

#include "reckon/aoim/interest/channel_table.hpp"
#include "reckon/aoim/interest/subscription.hpp"

namespace reckon::aoim {

/// Time [s] before a focus arrives at which groups of near rows are joined: a join takes up to
/// 0.03, and what is there is sent within 0.1 after that.
inline constexpr double kNearAhead = 0.3;
/// They are kept until the focus is farther than this times the row's end.
inline constexpr double kNearLeave = 1.1;

/// Settings of the subscription to the groups of a near row.
[[nodiscard]] SubscriptionConfig near_subscription(SubscriptionConfig cells) noexcept;

/// The focus from which a near row is subscribed to. Updates of kept rows use the groups of the row
/// after them, which include them at any stretch.
/// @param row of those of the table that are not kept, 0 being the nearest
/// @param focus with the sensing radius, or more if it stands for several; with less, it reaches no
/// farther than that
/// @param radius of sensing [m]  @param stretch see ChannelTable::fit
[[nodiscard]] Focus near_focus(const ChannelTable& table, std::size_t row, const Focus& focus,
                               double radius, double stretch) noexcept;

}  // namespace reckon::aoim
