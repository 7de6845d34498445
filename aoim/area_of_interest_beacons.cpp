// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The manager's beacons: those of ours, which are told with the cells they are in, and those of
// others, whose cells we listen to wherever they are.
#include <algorithm>

#include "reckon/aoim/area_of_interest_manager.hpp"

namespace reckon::aoim {
namespace {

using std::chrono::nanoseconds;

// What is shown stays so within this share of a cell beyond the one that is followed: where the
// beacon crosses a border it is heard in the next cell before the map says that it is there.
constexpr double kLingers = 0.5;

}  // namespace

void AreaOfInterestManager::set_beacons(std::span<const PlacedBeacon> beacons, nanoseconds now) {
  if (!hands_out()) return;
  carried_.clear();
  for (const PlacedBeacon& beacon : beacons)
    carried_.push_back({beacon.tag, cells_.cell_of(cells_.group(beacon.position))});
  leader_->set_beacons(carried_, now);
}

std::optional<CellId> AreaOfInterestManager::carried_in(std::uint32_t tag) const noexcept {
  const auto found = std::find_if(carried_.begin(), carried_.end(),
                                  [tag](const CarriedBeacon& one) { return one.tag == tag; });
  if (found == carried_.end()) return {};
  return found->cell;
}

// One that the map does not name is listened to where it was last for a while: its owner may have
// been unheard, or the map.
std::span<const GroupIndex> AreaOfInterestManager::find_followed(nanoseconds now) {
  besides_.clear();
  for (FollowedBeacon& one : followed_) {
    const auto row = leader_->directory().find_beacon(one.tag, now);
    const GroupIndex former = one.number;
    one.found = row.has_value();
    if (row) {
      one.number = cells_.group(CellId{row->column, row->row});
      one.cell = cells_.cell_of(one.number);
      one.group = {row->group};
      one.until = now + config_.leader.empty;
    } else if (now >= one.until) {
      one.number = {};
    }
    if (former.value > 0 && one.number != former) leap();
    if (one.number.value > 0) besides_.push_back(one.number);
  }
  return besides_;
}

bool AreaOfInterestManager::is_in_followed_cell(const Position& position,
                                                bool shown) const noexcept {
  const auto is_besides = [this](GroupIndex number) {
    return std::find(besides_.begin(), besides_.end(), number) != besides_.end();
  };
  if (!is_finite(position)) return false;
  if (is_besides(cells_.group(position)) || !shown) return is_besides(cells_.group(position));
  bool near = false;
  const double finest = config_.cells ? config_.cells->finest() : config_.grid.cell_size;
  cells_.visit([&](const auto& scheme) {
    scheme.for_each_cell_within(position, kLingers * finest, [&](CellId cell, double) {
      near = near || is_besides(scheme.group(cell));
    });
  });
  return near;
}

}  // namespace reckon::aoim
