// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The recipient tiers of a scene, and their multicast groups.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "reckon/aoim/groups/group_index.hpp"

namespace reckon::aoim {

/// All peers, without regard to their subscriptions: the base group.
inline constexpr std::size_t kEverybody = std::numeric_limits<std::size_t>::max();

/// The listeners of the cell: the outermost tier, which always exists.
inline constexpr std::size_t kCellTier = 0;

/// The tiers are: listeners of the cell, listeners in a near row of the channels (with near
/// groups), and peers that feel the entity (with contact groups). A listener of a tier is in all
/// outer tiers too, so an update for a tier reaches that tier and the inner ones.
///
/// Each tier has one group for each cell, with the numbers of the pool shifted by tier * pool.
/// Tiers are numbered: the cell, the near rows from the nearest on, then the felt tier. Three
/// numbers; any thread.
class TierTable {
 public:
  /// @param felt whether there are contact groups  @param near_rows rows with near groups
  /// @param pool groups of one tier, >= 1
  constexpr TierTable(bool felt, std::size_t near_rows, std::size_t pool) noexcept
      : felt_(felt), near_rows_(near_rows), pool_(pool) {}

  [[nodiscard]] constexpr std::size_t count() const noexcept {
    return 1 + near_rows_ + (felt_ ? 1 : 0);
  }
  [[nodiscard]] constexpr std::size_t near_rows() const noexcept { return near_rows_; }
  [[nodiscard]] constexpr bool is_near(std::size_t tier) const noexcept {
    return tier != kCellTier && tier <= near_rows_;
  }
  [[nodiscard]] constexpr bool has_felt() const noexcept { return felt_; }
  [[nodiscard]] constexpr bool is_felt(std::size_t tier) const noexcept {
    return felt_ && tier == felt();
  }
  /// The felt tier; only if has_felt().
  [[nodiscard]] constexpr std::size_t felt() const noexcept { return 1 + near_rows_; }

  /// Tier of a near row, 0 being the nearest; the cell tier for near_rows().
  [[nodiscard]] constexpr std::size_t of_row(std::size_t row) const noexcept {
    return row < near_rows_ ? row + 1 : kCellTier;
  }
  /// Row of a tier: near_rows() for the cell tier, and 0 for the felt tier, which is part of row 0.
  [[nodiscard]] constexpr std::size_t row_of(std::size_t tier) const noexcept {
    if (is_felt(tier)) return 0;
    return is_near(tier) ? tier - 1 : near_rows_;
  }

  /// @param cell group of a cell, not the base group
  [[nodiscard]] constexpr GroupIndex group(std::size_t tier, GroupIndex cell) const noexcept {
    return {static_cast<std::uint16_t>(cell.value + tier * pool_)};
  }
  /// The tier of a group; the cell tier for the base group and for numbers beyond all tiers.
  [[nodiscard]] constexpr std::size_t tier_of(GroupIndex group) const noexcept {
    const std::size_t tier = group == kBaseGroup ? kCellTier : (group.value - 1u) / pool_;
    return tier < count() ? tier : kCellTier;
  }
  /// The cell's group that corresponds to a group of any tier.
  [[nodiscard]] constexpr GroupIndex cell_of(GroupIndex group) const noexcept {
    return {static_cast<std::uint16_t>(group.value - tier_of(group) * pool_)};
  }

 private:
  bool felt_;
  std::size_t near_rows_, pool_;
};

}  // namespace reckon::aoim
