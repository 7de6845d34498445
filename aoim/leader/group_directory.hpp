// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A peer's copy of the map of groups: put together from parts, believed from whoever leads the
// scene alone, and for the time of its lease. Without a map a cell has no group, and what concerns
// it goes to the base group, which all hear.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "reckon/aoim/cells/cell_grid.hpp"
#include "reckon/aoim/leader/beacon_book.hpp"
#include "reckon/pdu/reckon/group_map.hpp"

namespace reckon::aoim {

/// One thread. Allocates as far as maps are larger than those before.
class GroupDirectory {
 public:
  static constexpr std::size_t kPerPart = 64;
  static constexpr std::size_t kMostRows = kMaximumPool + BeaconBook::kMost;
  static constexpr std::size_t kMostParts = (kMostRows + kPerPart - 1) / kPerPart;

  /// @param pool groups of the scene: a map that names others is refused
  GroupDirectory(std::size_t pool, std::chrono::nanoseconds lease);

  /// One part of a map, from the life `leader`. True where it completes one that is taken: newer
  /// than ours, the same again, or another leader's. A map that names a cell, a group or a beacon
  /// twice is refused; but that of a row of group 0, which is there for its beacon alone.
  bool receive(const pdu::GroupMap& part, std::uint32_t leader, std::chrono::nanoseconds now);
  /// We lead, and this is the map.
  void set(std::vector<pdu::CellGroup> entries, std::uint32_t version, std::uint32_t leader,
           std::chrono::nanoseconds now);

  /// Group of a cell, as long as the lease runs.
  [[nodiscard]] std::optional<GroupIndex> group(CellId cell,
                                                std::chrono::nanoseconds now) const noexcept;
  /// The same where it has been the cell's for `settle`, so that all who listen know it too.
  [[nodiscard]] std::optional<GroupIndex> settled_group(
      CellId cell, std::chrono::nanoseconds settle, std::chrono::nanoseconds now) const noexcept;
  /// The same whether or not the lease still runs: where others may speak.
  [[nodiscard]] std::optional<GroupIndex> last_group(CellId cell) const noexcept;
  /// Cell and group of a beacon, as long as the lease runs; group 0: the base group.
  [[nodiscard]] std::optional<pdu::CellGroup> find_beacon(
      std::uint32_t tag, std::chrono::nanoseconds now) const noexcept;

  /// Whether the lease runs.
  [[nodiscard]] bool holds(std::chrono::nanoseconds now) const noexcept {
    return leader_ != 0 && now - heard_ < lease_;
  }
  /// When the lease ends or has ended; the earliest time there is where no map was ever heard.
  [[nodiscard]] std::chrono::nanoseconds lease_end() const noexcept {
    return leader_ == 0 ? std::chrono::nanoseconds::min() : heard_ + lease_;
  }
  /// How long we had heard none when the last one came; 0 of the first one.
  [[nodiscard]] std::chrono::nanoseconds pause() const noexcept { return pause_; }
  /// All entries, by cell, whether or not the lease still runs.
  [[nodiscard]] std::span<const pdu::CellGroup> entries() const noexcept { return entries_; }
  /// All beacons, by tag, likewise.
  [[nodiscard]] std::span<const pdu::CellGroup> beacons() const noexcept { return beacons_; }
  /// Rows of groups that were in quarantine when the map was said; see resting_row.
  [[nodiscard]] std::span<const pdu::CellGroup> resting() const noexcept { return resting_; }
  [[nodiscard]] std::uint32_t version() const noexcept { return version_; }
  /// Life that said it; 0: no map was ever heard.
  [[nodiscard]] std::uint32_t leader() const noexcept { return leader_; }
  /// Maps refused because they contradict themselves or the pool.
  [[nodiscard]] std::uint64_t refused() const noexcept { return refused_; }

 private:
  struct Pending {
    std::uint32_t leader = 0, version = 0;
    std::uint16_t parts = 0;
    std::array<bool, kMostParts> got{};
    std::vector<pdu::CellGroup> entries;
  };
  [[nodiscard]] bool is_sound(std::span<const pdu::CellGroup> rows) const;
  void take_beacons(std::vector<pdu::CellGroup>& rows);
  [[nodiscard]] std::size_t find(CellId cell) const noexcept;  // none: as many as there are

  std::size_t pool_;
  std::chrono::nanoseconds lease_;
  Pending pending_;
  std::vector<pdu::CellGroup> entries_, resting_, beacons_;
  std::vector<std::chrono::nanoseconds> since_;  ///< of entries_, without a pause
  std::uint32_t version_ = 0, leader_ = 0;
  std::chrono::nanoseconds heard_{}, pause_{};
  std::uint64_t refused_ = 0;
};

}  // namespace reckon::aoim
