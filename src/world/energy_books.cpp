// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/energy_books.hpp"

#include <algorithm>

namespace reckon::peer {

EnergyBooks::EnergyBooks() : index_(kPairs) { pairs_.reserve(kPairs); }

std::uint64_t EnergyBooks::key(EntityNumber own, const pdu::EntityId& other) noexcept {
  return std::uint64_t{own} << 48 | other.key();
}

ReceivedAccount& EnergyBooks::pair(EntityNumber own, const pdu::EntityId& other,
                                   std::chrono::nanoseconds now) noexcept {
  const std::uint32_t known = index_.find(key(own, other));
  if (known != KeyIndex::kNone) {
    pairs_[known].heard = now;
    return pairs_[known];
  }
  if (pairs_.size() == kPairs) {
    const auto oldest =
        std::min_element(pairs_.begin(), pairs_.end(),
                         [](const auto& a, const auto& b) { return a.heard < b.heard; });
    erase(static_cast<std::size_t>(oldest - pairs_.begin()));
  }
  index_.put(key(own, other), pairs_.size());
  ReceivedAccount& made = pairs_.emplace_back();
  made.own = own;
  made.other = other;
  made.heard = now;
  return made;
}

const ReceivedAccount* EnergyBooks::find(EntityNumber own,
                                         const pdu::EntityId& other) const noexcept {
  const std::uint32_t place = index_.find(key(own, other));
  return place == KeyIndex::kNone ? nullptr : &pairs_[place];
}

void EnergyBooks::forget(EntityNumber own) noexcept {
  for (std::size_t i = 0; i < pairs_.size();) {
    if (pairs_[i].own == own) {
      erase(i);
    } else {
      ++i;
    }
  }
}

void EnergyBooks::erase(std::size_t place) noexcept {
  index_.erase(key(pairs_[place].own, pairs_[place].other));
  if (place + 1 < pairs_.size()) {
    pairs_[place] = pairs_.back();
    index_.put(key(pairs_[place].own, pairs_[place].other), place);
  }
  pairs_.pop_back();
}

void PowerBudget::advance(double dt, bool moves) noexcept {
  if (moves) level_ = std::min(level_ + power_ * dt, power_ * kSaved);
}

double PowerBudget::take(double wanted) noexcept {
  const double taken = std::clamp(wanted, 0.0, level_);
  level_ -= taken;
  return taken;
}

}  // namespace reckon::peer
