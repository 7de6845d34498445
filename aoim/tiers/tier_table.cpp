// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/tiers/tier_table.hpp"

namespace reckon::aoim {

TierTable::TierTable(std::span<const TierKind* const> besides, std::size_t pool) : pool_(pool) {
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

}  // namespace reckon::aoim
