// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/tiers/tier_subscriptions.hpp"

#include <utility>

namespace reckon::aoim {

TierSubscriptions::TierSubscriptions(const TierTable& tiers, const CellPartition& cells,
                                     const SubscriptionConfig& config, TierReach reach)
    : tiers_(tiers), reach_(std::move(reach)) {
  by_tier_.reserve(tiers.count());
  for (std::size_t tier = 0; tier < tiers.count(); ++tier) {
    const auto subscription = tiers.kind(tier).subscription;
    by_tier_.emplace_back(cells, subscription == nullptr ? config : subscription(config));
  }
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

std::span<const Focus> TierSubscriptions::reach_of(std::size_t tier, std::span<const Focus> foci) {
  const auto focus_of = tiers_.kind(tier).focus;
  if (focus_of == nullptr) return foci;
  foci_.assign(foci.begin(), foci.end());
  for (Focus& focus : foci_) focus = focus_of(focus, tiers_.row_of(tier), reach_);
  return foci_;
}

}  // namespace reckon::aoim
