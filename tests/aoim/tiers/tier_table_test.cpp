// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/tiers/tier_table.hpp"

#include <gtest/gtest.h>

#include <set>

namespace reckon::aoim {
namespace {

TEST(TierTable, HasTheCellAloneWhereNothingElseIsAskedFor) {
  constexpr TierTable tiers(false, 0, 4);
  EXPECT_EQ(tiers.count(), 1u);
  for (std::uint16_t group = 0; group <= 4; ++group) {
    EXPECT_EQ(tiers.tier_of({group}), kCellTier);
    EXPECT_EQ(tiers.cell_of({group}), GroupIndex{group});
  }
  EXPECT_FALSE(tiers.has_felt() || tiers.is_felt(1) || tiers.is_near(kCellTier));
  EXPECT_EQ(tiers.row_of(kCellTier), 0u);
}

TEST(TierTable, GivesEachTierAndCellAGroupOfItsOwn) {
  for (const bool felt : {false, true}) {
    for (const std::size_t rows : {0u, 1u, 3u}) {
      constexpr std::size_t kPool = 7;
      const TierTable tiers(felt, rows, kPool);
      ASSERT_EQ(tiers.count(), 1 + rows + (felt ? 1 : 0));
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

TEST(TierTable, KnowsRowsByTierAndTiersByRow) {
  constexpr TierTable tiers(true, 2, 5);
  for (std::size_t row = 0; row <= 2; ++row) EXPECT_EQ(tiers.row_of(tiers.of_row(row)), row);
  EXPECT_EQ(tiers.of_row(2), kCellTier);
  EXPECT_EQ(tiers.row_of(tiers.felt()), 0u);
  EXPECT_TRUE(tiers.is_felt(tiers.felt()));
  EXPECT_FALSE(tiers.is_near(tiers.felt()));
}

TEST(TierTable, TakesNumbersBeyondAllTiersForCells) {
  constexpr TierTable tiers(true, 1, 5);
  EXPECT_EQ(tiers.tier_of({16}), kCellTier);
  EXPECT_EQ(tiers.cell_of({16}), GroupIndex{16});
}

}  // namespace
}  // namespace reckon::aoim
