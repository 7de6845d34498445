// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/disputes.hpp"

#include <algorithm>

namespace reckon::peer {

// Compares the sending host without its port, because a host can change ports at no cost.
Disputes::Pair* Disputes::find(const Dispute& dispute) noexcept {
  const auto end = pairs_.begin() + static_cast<std::ptrdiff_t>(count_);
  const auto found = std::find_if(pairs_.begin(), end, [&](const Pair& pair) {
    return pair.dispute.name == dispute.name &&
           pair.dispute.speaker.octets == dispute.speaker.octets;
  });
  return found == end ? nullptr : &*found;
}

void Disputes::note(const Dispute& dispute, std::chrono::nanoseconds now) noexcept {
  if (Pair* known = find(dispute)) {
    if (now - known->last > kQuiet) *known = {dispute, now, now, false};
    known->last = now;
    return;
  }
  const auto quietest = [](const Pair& a, const Pair& b) { return a.last < b.last; };
  Pair& place = count_ < kPairs ? pairs_[count_++]
                                : *std::min_element(pairs_.begin(), pairs_.end(), quietest);
  place = {dispute, now, now, false};
}

std::optional<Dispute> Disputes::take_news(std::chrono::nanoseconds now) noexcept {
  if (last_news_ && now - *last_news_ < kGap) return {};
  Pair* oldest = nullptr;
  for (std::size_t i = 0; i < count_; ++i) {
    Pair& pair = pairs_[i];
    if (!pair.reported && (oldest == nullptr || pair.first < oldest->first)) oldest = &pair;
  }
  if (oldest == nullptr) return {};
  oldest->reported = true;
  last_news_ = now;
  return oldest->dispute;
}

}  // namespace reckon::peer
