// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/tiers/tier_subscriptions.hpp"

#include <algorithm>

#include "reckon/aoim/interest/near_rows.hpp"

namespace reckon::aoim {
namespace {

// A contact group is joined at a distance smaller by this factor than the one at which it is left.
constexpr double kContactLeave = 2.0;

SubscriptionConfig subscription_of(const TierTable& tiers, std::size_t tier,
                                   SubscriptionConfig config) {
  if (tiers.is_near(tier)) return near_subscription(config);
  if (!tiers.is_felt(tier)) return config;
  config.leave_factor = std::max(config.leave_factor, kContactLeave);
  config.maximum_groups = kMaximumPool;  // a felt entity is never left out
  return config;
}

}  // namespace

TierSubscriptions::TierSubscriptions(const TierTable& tiers, const CellPartition& cells,
                                     const SubscriptionConfig& config, const TierReach& reach)
    : tiers_(tiers), radius_(reach.radius), farthest_nimbus_(reach.farthest_nimbus) {
  by_tier_.reserve(tiers.count());
  for (std::size_t tier = 0; tier < tiers.count(); ++tier)
    by_tier_.emplace_back(cells, subscription_of(tiers, tier, config));
  if (tiers.near_rows() > 0) rows_.emplace(reach.channels);
  join_.reserve(cells.groups());
  leave_.reserve(cells.groups());
}

SubscriptionChange TierSubscriptions::update(std::size_t tier, std::span<const Focus> foci,
                                             std::chrono::nanoseconds now,
                                             std::span<const GroupIndex> besides) {
  return by_tier_[tier].update(reach_of(tier, foci), now, besides);
}

SubscriptionChange TierSubscriptions::groups_of(std::size_t tier, const SubscriptionChange& cells) {
  join_.clear();
  leave_.clear();
  for (const GroupIndex cell : cells.join) join_.push_back(tiers_.group(tier, cell));
  for (const GroupIndex cell : cells.leave) leave_.push_back(tiers_.group(tier, cell));
  return {join_, leave_, cells.uncovered, cells.covered_share};
}

void TierSubscriptions::note(const SubscriptionChange& groups) noexcept {
  const auto set = [this](GroupIndex group, bool joined) {
    if (group.value >= joined_.size() || joined_[group.value] == joined) return;
    joined_[group.value] = joined;
    joined_count_ = joined ? joined_count_ + 1 : joined_count_ - 1;
  };
  for (const GroupIndex group : groups.join) set(group, true);
  for (const GroupIndex group : groups.leave) set(group, false);
}

// The foci with the radius of the tier, which may be larger or smaller than theirs.
std::span<const Focus> TierSubscriptions::reach_of(std::size_t tier, std::span<const Focus> foci) {
  const bool is_wide = tier == kCellTier && farthest_nimbus_ > 0.0;
  if (!is_wide && !tiers_.is_near(tier)) return foci;
  foci_.assign(foci.begin(), foci.end());
  for (Focus& focus : foci_) {
    if (is_wide)
      focus.radius += farthest_nimbus_;
    else
      focus = near_focus(*rows_, tiers_.row_of(tier), focus, radius_, stretch_);
  }
  return foci_;
}

}  // namespace reckon::aoim
