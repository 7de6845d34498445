// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The cell of each beacon, from the roles that its owner sends. A beacon is a tag that an owner
// carries from cell to cell. The leader of the scene publishes its cell in the map of groups, so
// that others find it anywhere.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string_view>

#include "reckon/aoim/cells/cell_grid.hpp"

namespace reckon::aoim {

/// Tag that stands for a beacon's name on the wire: 32-bit FNV-1a, never 0.
[[nodiscard]] constexpr std::uint32_t beacon_tag(std::string_view name) noexcept {
  std::uint32_t tag = 0x811C9DC5U;
  for (const char letter : name) tag = (tag ^ static_cast<unsigned char>(letter)) * 0x01000193U;
  return tag == 0 ? 1 : tag;
}

/// One thread; allocates when beacons are new. If two owners use the same tag, the first one keeps
/// it until it becomes silent or leaves.
class BeaconBook {
 public:
  using Nanoseconds = std::chrono::nanoseconds;
  /// Most beacons in all, and of one owner.
  static constexpr std::size_t kMost = 256, kMostOfOne = 64;

  /// @param patience a beacon expires this long after it was last received
  explicit BeaconBook(Nanoseconds patience) : patience_(patience) {}

  /// Records that the peer with the epoch `owner` has its beacon in this cell. True if that is new.
  bool receive(std::uint32_t tag, CellId cell, std::uint32_t owner, Nanoseconds now);
  /// Records that this owner has left the cell. True if a beacon was removed.
  bool leave(CellId cell, std::uint32_t owner);
  /// Records that this epoch has ended. True if it had a beacon.
  bool forget(std::uint32_t owner);
  /// Removes beacons that are no longer received. True if there were any.
  bool expire(Nanoseconds now);

  /// Calls visit(tag, CellId) for each, by tag.
  void for_each(auto&& visit) const {
    for (const auto& [tag, beacon] : beacons_) visit(tag, beacon.cell);
  }
  [[nodiscard]] std::size_t size() const noexcept { return beacons_.size(); }

 private:
  struct Beacon {
    CellId cell;
    std::uint32_t owner = 0;  ///< epoch
    Nanoseconds heard{};
  };
  Nanoseconds patience_;
  std::map<std::uint32_t, Beacon> beacons_;  ///< by tag
};

}  // namespace reckon::aoim
