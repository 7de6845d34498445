// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The recipient tiers of a scene, and which multicast groups are theirs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "reckon/aoim/groups/group_index.hpp"

namespace reckon::aoim {

/// Everybody, whatever they listen to: the base group.
inline constexpr std::size_t kEverybody = std::numeric_limits<std::size_t>::max();

/// Who listens to the cell: the outmost tier, which always is.
inline constexpr std::size_t kCellTier = 0;

/// Tiers: who listens to the cell, who is in a near row of the channels (with near groups), who
/// feels the entity (with contact groups). Who listens to a tier listens to all farther out too, so
/// an update for a tier reaches that tier and those farther in.
///
/// Each tier has a group for each cell: the pool's numbers again. A tier's number is that of the
/// pools before its own: the cell, then the near rows, the nearest first, then what is felt. Three
/// numbers; any thread.
class TierTable {
 public:
  /// @param felt there are contact groups  @param near_rows rows with near groups
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
  /// The tier of what is felt, where has_felt().
  [[nodiscard]] constexpr std::size_t felt() const noexcept { return 1 + near_rows_; }

  /// Tier of a near row, the nearest being 0; of near_rows(): the cell.
  [[nodiscard]] constexpr std::size_t of_row(std::size_t row) const noexcept {
    return row < near_rows_ ? row + 1 : kCellTier;
  }
  /// Row of a tier: near_rows() of the cell; who feels an entity is among those of row 0.
  [[nodiscard]] constexpr std::size_t row_of(std::size_t tier) const noexcept {
    if (is_felt(tier)) return 0;
    return is_near(tier) ? tier - 1 : near_rows_;
  }

  /// @param cell group of a cell, not the base group
  [[nodiscard]] constexpr GroupIndex group(std::size_t tier, GroupIndex cell) const noexcept {
    return {static_cast<std::uint16_t>(cell.value + tier * pool_)};
  }
  /// The tier that a group is of; of the base group, and of numbers beyond all tiers: the cell's.
  [[nodiscard]] constexpr std::size_t tier_of(GroupIndex group) const noexcept {
    const std::size_t tier = group == kBaseGroup ? kCellTier : (group.value - 1u) / pool_;
    return tier < count() ? tier : kCellTier;
  }
  /// The group of the cell that a group of any tier is of.
  [[nodiscard]] constexpr GroupIndex cell_of(GroupIndex group) const noexcept {
    return {static_cast<std::uint16_t>(group.value - tier_of(group) * pool_)};
  }

 private:
  bool felt_;
  std::size_t near_rows_, pool_;
};

}  // namespace reckon::aoim
