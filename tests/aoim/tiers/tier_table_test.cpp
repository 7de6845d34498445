// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/tiers/tier_table.hpp"

#include <gtest/gtest.h>

#include <set>
#include <vector>

namespace reckon::aoim {
namespace {

std::vector<const TierKind*> kinds(std::size_t by_distance, std::size_t by_touch) {
  std::vector<const TierKind*> result(by_distance, &kDistanceKind);
  result.insert(result.end(), by_touch, &kTouchKind);
  return result;
}

TEST(TierTable, HasOnlyTheCellByDefault) {
  const TierTable tiers({}, 4);
  EXPECT_EQ(tiers.count(), 1u);
  for (std::uint16_t group = 0; group <= 4; ++group) {
    EXPECT_EQ(tiers.tier_of({group}), kCellTier);
    EXPECT_EQ(tiers.cell_of({group}), GroupIndex{group});
  }
  EXPECT_EQ(&tiers.kind(kCellTier), &kCellKind);
  EXPECT_TRUE(tiers.urgent().empty());
  EXPECT_EQ(tiers.row_of(kCellTier), 0u);
}

TEST(TierTable, GivesEachTierAndCellItsOwnGroup) {
  for (const std::size_t touch : {0u, 1u}) {
    for (const std::size_t rows : {0u, 1u, 3u}) {
      constexpr std::size_t kPool = 7;
      const TierTable tiers(kinds(rows, touch), kPool);
      ASSERT_EQ(tiers.count(), 1 + rows + touch);
      std::set<GroupIndex> groups;
      for (std::size_t tier = 0; tier < tiers.count(); ++tier) {
        for (std::uint16_t cell = 1; cell <= kPool; ++cell) {
          const GroupIndex group = tiers.group(tier, {cell});
          EXPECT_TRUE(groups.insert(group).second);
          EXPECT_EQ(tiers.tier_of(group), tier);
          EXPECT_EQ(tiers.cell_of(group), GroupIndex{cell});
        }
      }
      EXPECT_EQ(groups.begin()->value, 1);
      EXPECT_EQ(groups.rbegin()->value, kPool * tiers.count()) << "none between is unused";
    }
  }
}

// Groups are numbered in the order of the kinds, independent of their nesting.
TEST(TierTable, KnowsRowsByTierAndTiersByRow) {
  const std::vector orders{kinds(2, 1), std::vector{&kTouchKind, &kDistanceKind, &kDistanceKind},
                           std::vector{&kDistanceKind, &kTouchKind, &kDistanceKind}};
  for (const std::vector<const TierKind*>& order : orders) {
    const TierTable tiers(order, 5);
    ASSERT_EQ(tiers.last_row(), 2u);
    for (std::size_t row = 0; row <= 2; ++row) EXPECT_EQ(tiers.row_of(tiers.of_row(row)), row);
    EXPECT_TRUE(tiers.kind(tiers.of_row(0)).runs_ahead);
    EXPECT_LT(tiers.of_row(0), tiers.of_row(1));
    EXPECT_EQ(tiers.of_row(2), kCellTier);
    ASSERT_EQ(tiers.urgent().size(), 1u);
    EXPECT_TRUE(tiers.kind(tiers.urgent().front()).is_urgent);
    EXPECT_EQ(tiers.row_of(tiers.urgent().front()), 0u);
  }
}

TEST(TierTable, MapsNumbersBeyondAllTiersToCells) {
  const TierTable tiers(kinds(1, 1), 5);
  EXPECT_EQ(tiers.tier_of({16}), kCellTier);
  EXPECT_EQ(tiers.cell_of({16}), GroupIndex{16});
}

// Assumptions of the layer about each row of THE list.
TEST(TierKinds, NonCellKindsAreUrgentOrRunAhead) {
  for (const TierKind* kind : tier_kinds()) {
    const bool is_cell = kind == &kCellKind;
    EXPECT_EQ(kind->is_urgent != kind->runs_ahead, !is_cell);
    EXPECT_FALSE(kind->is_urgent && kind->runs_ahead);
    EXPECT_EQ(kind->name.empty(), is_cell);
    EXPECT_EQ(kind->groups.empty(), is_cell);
  }
}

}  // namespace
}  // namespace reckon::aoim
