// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The recipient tiers of a scene, and their multicast groups.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "reckon/aoim/groups/group_index.hpp"
#include "reckon/aoim/tiers/tier_kind.hpp"

namespace reckon::aoim {

/// All peers, without regard to their subscriptions: the base group.
inline constexpr std::size_t kEverybody = std::numeric_limits<std::size_t>::max();

/// The listeners of the cell: the outermost tier, which always exists.
inline constexpr std::size_t kCellTier = 0;

/// The tiers, each of a kind. A listener of a tier is in all outer tiers too, so an update for a
/// tier reaches that tier and the inner ones. The innermost are the urgent tiers; then follow the
/// tiers that run ahead, one for each row of channels, and then the cell.
///
/// Each tier has one group for each cell, with the numbers of the pool shifted by tier * pool.
/// Immutable: any thread. Allocates at construction.
class TierTable {
 public:
  /// @param besides kinds of all tiers except the cell's, in the order of their groups; of the
  /// tiers that run ahead, the innermost is first @param pool groups of one tier, >= 1
  TierTable(std::span<const TierKind* const> besides, std::size_t pool) : pool_(pool) {
    kinds_.push_back(&kCellKind);
    kinds_.insert(kinds_.end(), besides.begin(), besides.end());
    rows_.resize(kinds_.size(), 0);
    for (std::size_t tier = kCellTier + 1; tier < kinds_.size(); ++tier) {
      if (kinds_[tier]->is_urgent) {
        urgent_.push_back(tier);
      } else {
        rows_[tier] = ahead_.size();
        ahead_.push_back(tier);
      }
    }
    rows_[kCellTier] = last_row();
  }

  [[nodiscard]] std::size_t count() const noexcept { return kinds_.size(); }
  [[nodiscard]] const TierKind& kind(std::size_t tier) const noexcept { return *kinds_[tier]; }
  /// The urgent tiers.
  [[nodiscard]] std::span<const std::size_t> urgent() const noexcept { return urgent_; }

  /// Tier with this row of channels, counted without the kept rows from 0, the nearest; the cell
  /// tier from last_row() on.
  [[nodiscard]] std::size_t of_row(std::size_t row) const noexcept {
    return row < ahead_.size() ? ahead_[row] : kCellTier;
  }
  /// Row of channels of a tier; 0 for urgent ones, which share the nearest row.
  [[nodiscard]] std::size_t row_of(std::size_t tier) const noexcept { return rows_[tier]; }
  /// Row of the cell tier: the number of tiers that run ahead.
  [[nodiscard]] std::size_t last_row() const noexcept { return ahead_.size(); }

  /// @param cell group of a cell, not the base group
  [[nodiscard]] GroupIndex group(std::size_t tier, GroupIndex cell) const noexcept {
    return {static_cast<std::uint16_t>(cell.value + tier * pool_)};
  }
  /// The tier of a group; the cell tier for the base group and for numbers beyond all tiers.
  [[nodiscard]] std::size_t tier_of(GroupIndex group) const noexcept {
    const std::size_t tier = group == kBaseGroup ? kCellTier : (group.value - 1u) / pool_;
    return tier < count() ? tier : kCellTier;
  }
  /// The cell's group that corresponds to a group of any tier.
  [[nodiscard]] GroupIndex cell_of(GroupIndex group) const noexcept {
    return {static_cast<std::uint16_t>(group.value - tier_of(group) * pool_)};
  }

 private:
  std::size_t pool_;
  std::vector<const TierKind*> kinds_;  // by tier
  std::vector<std::size_t> rows_;       // by tier
  std::vector<std::size_t> urgent_;     // tiers
  std::vector<std::size_t> ahead_;      // tiers by row
};

}  // namespace reckon::aoim
