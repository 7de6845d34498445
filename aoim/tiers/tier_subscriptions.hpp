// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The subscribed cells of this peer, by tier.
#pragma once

#include <chrono>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "reckon/aoim/cells/cell_partition.hpp"
#include "reckon/aoim/interest/subscription.hpp"
#include "reckon/aoim/tiers/tier_kind.hpp"
#include "reckon/aoim/tiers/tier_table.hpp"

namespace reckon::aoim {

/// One subscription for each tier, all to the same cells. One thread; allocates at construction and
/// when there are more foci than ever before.
class TierSubscriptions {
 public:
  /// @param config of the subscription to the cells  @param cells outlives this
  /// @throws std::invalid_argument from Subscription
  TierSubscriptions(const TierTable& tiers, const CellPartition& cells,
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

  /// Subscription of the cell tier; cells are numbered as in the partition.
  [[nodiscard]] const Subscription& cells() const noexcept { return by_tier_.front(); }
  [[nodiscard]] const Subscription& of(std::size_t tier) const noexcept { return by_tier_[tier]; }
  /// Whether we have joined this group, of any tier or assigned by a leader; always true for the
  /// base group.
  [[nodiscard]] bool hears(GroupIndex group) const noexcept {
    return group == kBaseGroup || (group.value < joined_.size() && joined_[group.value]);
  }
  /// Number of joined groups without the base group.
  [[nodiscard]] std::size_t joined_groups() const noexcept { return joined_count_; }

  /// Sets TierReach::stretch.
  void set_stretch(double stretch) noexcept { reach_.stretch = stretch; }
  /// Subscribes to the cells in reach of these foci, and to `besides`.
  /// @return changed cells, by number, valid until the next call for this tier
  SubscriptionChange update(std::size_t tier, std::span<const Focus> foci,
                            std::chrono::nanoseconds now,
                            std::span<const GroupIndex> besides = {}) {
    return by_tier_[tier].update(reach_of(tier, foci), now, besides);
  }
  /// Maps changed cells to the groups of this tier.  @return valid until the next call
  SubscriptionChange groups_of(std::size_t tier, const SubscriptionChange& cells) {
    join_.clear();
    leave_.clear();
    for (const GroupIndex cell : cells.join) join_.push_back(tiers_.group(tier, cell));
    for (const GroupIndex cell : cells.leave) leave_.push_back(tiers_.group(tier, cell));
    return {join_, leave_, cells.uncovered, cells.covered_share};
  }
  /// Records joined and left groups, on which hears() depends.
  void note(const SubscriptionChange& groups) noexcept {
    const auto set = [this](GroupIndex group, bool joined) {
      if (group.value >= joined_.size() || joined_[group.value] == joined) return;
      joined_[group.value] = joined;
      joined_count_ = joined ? joined_count_ + 1 : joined_count_ - 1;
    };
    for (const GroupIndex group : groups.join) set(group, true);
    for (const GroupIndex group : groups.leave) set(group, false);
  }

 private:
  [[nodiscard]] std::span<const Focus> reach_of(std::size_t tier, std::span<const Focus> foci) {
    const auto focus_of = tiers_.kind(tier).focus;
    if (focus_of == nullptr) return foci;
    foci_.assign(foci.begin(), foci.end());
    for (Focus& focus : foci_) focus = focus_of(focus, tiers_.row_of(tier), reach_);
    return foci_;
  }

  TierTable tiers_;
  std::vector<Subscription> by_tier_;
  TierReach reach_;
  std::vector<Focus> foci_;  ///< with the reach of a tier
  std::vector<GroupIndex> join_, leave_;
  std::vector<bool> joined_ = std::vector<bool>(kMaximumPool + 1);  ///< by group
  std::size_t joined_count_ = 0;
};

}  // namespace reckon::aoim
