// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// In which cell each beacon is, by what its owners say in their roles. A beacon is a tag that an
// owner carries from cell to cell; who leads the scene tells in the map of groups where it is, so
// that others find it wherever it goes.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string_view>

#include "reckon/aoim/cells/cell_grid.hpp"

namespace reckon::aoim {

/// The number by which a beacon's name goes over the wire: FNV-1a of 32 bits; never 0.
[[nodiscard]] constexpr std::uint32_t beacon_tag(std::string_view name) noexcept {
  std::uint32_t tag = 0x811C9DC5U;
  for (const char letter : name) tag = (tag ^ static_cast<unsigned char>(letter)) * 0x01000193U;
  return tag == 0 ? 1 : tag;
}

/// One thread; allocates when beacons are new. Where two owners say the same tag, who was heard
/// first keeps it until it falls silent or leaves.
class BeaconBook {
 public:
  using Nanoseconds = std::chrono::nanoseconds;
  /// Beacons at most, and of one owner.
  static constexpr std::size_t kMost = 256, kMostOfOne = 64;

  /// @param patience so long after its last word a beacon is gone
  explicit BeaconBook(Nanoseconds patience) : patience_(patience) {}

  /// The life `owner` says that its beacon is in this cell. True where that is news.
  bool hear(std::uint32_t tag, CellId cell, std::uint32_t owner, Nanoseconds now);
  /// This owner has left the cell. True where a beacon went with it.
  bool leave(CellId cell, std::uint32_t owner);
  /// This life is over. True where it had a beacon.
  bool forget(std::uint32_t owner);
  /// Forgets those that nobody speaks of. True where there were any.
  bool expire(Nanoseconds now);

  /// Calls visit(tag, CellId) for each, by tag.
  template <typename Visit>
  void for_each(Visit&& visit) const {
    for (const auto& [tag, beacon] : beacons_) visit(tag, beacon.cell);
  }
  [[nodiscard]] std::size_t size() const noexcept { return beacons_.size(); }

 private:
  struct Beacon {
    CellId cell;
    std::uint32_t owner = 0;  ///< life
    Nanoseconds heard{};
  };
  Nanoseconds patience_;
  std::map<std::uint32_t, Beacon> beacons_;  ///< by tag
};

}  // namespace reckon::aoim
