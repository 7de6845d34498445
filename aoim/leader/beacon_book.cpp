// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/leader/beacon_book.hpp"

#include <algorithm>

namespace reckon::aoim {

bool BeaconBook::receive(std::uint32_t tag, CellId cell, std::uint32_t owner, Nanoseconds now) {
  const auto known = beacons_.find(tag);
  if (known == beacons_.end()) {
    const auto of_owner = static_cast<std::size_t>(
        std::count_if(beacons_.begin(), beacons_.end(),
                      [owner](const auto& item) { return item.second.owner == owner; }));
    if (tag == 0 || beacons_.size() >= kMost || of_owner >= kMostOfOne) return false;
    beacons_[tag] = {cell, owner, now};
    return true;
  }
  Beacon& beacon = known->second;
  if (beacon.owner != owner && now - beacon.heard < patience_) return false;
  const bool moved = beacon.cell != cell;
  beacon = {cell, owner, now};
  return moved;
}

bool BeaconBook::leave(CellId cell, std::uint32_t owner) {
  return std::erase_if(beacons_, [&](const auto& item) {
           return item.second.owner == owner && item.second.cell == cell;
         }) > 0;
}

bool BeaconBook::forget(std::uint32_t owner) {
  return std::erase_if(beacons_, [owner](const auto& item) { return item.second.owner == owner; }) >
         0;
}

bool BeaconBook::expire(Nanoseconds now) {
  return std::erase_if(beacons_,
                       [&](const auto& item) { return now - item.second.heard >= patience_; }) > 0;
}

}  // namespace reckon::aoim
