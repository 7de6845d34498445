// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Which cells this peer listens to, in each tier.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "reckon/aoim/cells/cell_partition.hpp"
#include "reckon/aoim/interest/channel_table.hpp"
#include "reckon/aoim/interest/subscription.hpp"
#include "reckon/aoim/tiers/tier_table.hpp"

namespace reckon::aoim {

/// How far the tiers reach beyond the foci.
struct TierReach {
  double radius = 0.0;            ///< how far entities sense [m], >= 0
  double farthest_nimbus = 0.0;   ///< [m], >= 0: cells are joined so much farther
  std::vector<Channel> channels;  ///< of the near rows; may be empty where there are none
};

/// A subscription by tier, all to the same cells. One thread; allocates at construction and as
/// foci are more than ever before.
class TierSubscriptions {
 public:
  /// @param cells outlives this  @throws std::invalid_argument as Subscription and ChannelTable do
  TierSubscriptions(const TierTable& tiers, const CellPartition& cells,
                    const SubscriptionConfig& config, const TierReach& reach);

  /// Of the cells' tier: cells are numbered as in the partition.
  [[nodiscard]] const Subscription& cells() const noexcept { return by_tier_.front(); }
  [[nodiscard]] const Subscription& of(std::size_t tier) const noexcept { return by_tier_[tier]; }
  /// Whether we have joined this group, of whatever tier or handed out; the base group always.
  [[nodiscard]] bool hears(GroupIndex group) const noexcept {
    return group == kBaseGroup || (group.value < joined_.size() && joined_[group.value]);
  }
  /// How many, the base group not counted.
  [[nodiscard]] std::size_t joined_groups() const noexcept { return joined_count_; }

  /// What near rows make of distances; see ChannelTable::fit. > 0
  void set_stretch(double stretch) noexcept { stretch_ = stretch; }
  /// Listens to the cells that these foci reach, and to `besides`. @return cells, by their numbers,
  /// until the next call for this tier
  SubscriptionChange update(std::size_t tier, std::span<const Focus> foci,
                            std::chrono::nanoseconds now, std::span<const GroupIndex> besides = {});
  /// The same groups as the tier has them. @return until the next call
  SubscriptionChange groups_of(std::size_t tier, const SubscriptionChange& cells);
  /// These groups are joined and left: what hears() answers from now on.
  void note(const SubscriptionChange& groups) noexcept;

 private:
  [[nodiscard]] std::span<const Focus> reach_of(std::size_t tier, std::span<const Focus> foci);

  TierTable tiers_;
  std::vector<Subscription> by_tier_;
  std::optional<ChannelTable> rows_;
  double radius_, farthest_nimbus_, stretch_ = 1.0;
  std::vector<Focus> foci_;  ///< as far as a tier reaches
  std::vector<GroupIndex> join_, leave_;
  std::vector<bool> joined_ = std::vector<bool>(kMaximumPool + 1);  ///< by group
  std::size_t joined_count_ = 0;
};

}  // namespace reckon::aoim
