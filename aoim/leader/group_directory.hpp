// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A peer's copy of the map of groups. It is assembled from parts, accepted only from the leader of
// the scene, and valid for its lease. Without a map a cell has no group, and its traffic goes to
// the base group, which all peers receive.
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

/// One thread. Allocates when a map is larger than all before.
class GroupDirectory {
 public:
  static constexpr std::size_t kPerPart = 64;
  static constexpr std::size_t kMostRows = kMaximumPool + BeaconBook::kMost;
  static constexpr std::size_t kMostParts = (kMostRows + kPerPart - 1) / kPerPart;

  /// @param pool groups of the scene: a map with other groups is refused
  GroupDirectory(std::size_t pool, std::chrono::nanoseconds lease);

  /// Takes one part of a map from the epoch `leader`. Returns true if the part completes a map that
  /// is accepted: a newer one, the same one again, or one of another leader. A map that contains a
  /// cell, a group or a beacon twice is refused. The cell of a row with group 0 may repeat: such a
  /// row only carries a beacon.
  bool receive(const pdu::GroupMap& part, std::uint32_t leader, std::chrono::nanoseconds now);
  /// Sets the map, which we publish as the leader.
  void set(std::vector<pdu::CellGroup> entries, std::uint32_t version, std::uint32_t leader,
           std::chrono::nanoseconds now);

  /// Group of a cell, as long as the lease runs.
  [[nodiscard]] std::optional<GroupIndex> group(CellId cell,
                                                std::chrono::nanoseconds now) const noexcept;
  /// The same, if the cell has had it for `settle`, so that all listeners have received the
  /// assignment.
  [[nodiscard]] std::optional<GroupIndex> settled_group(
      CellId cell, std::chrono::nanoseconds settle, std::chrono::nanoseconds now) const noexcept;
  /// The same without regard to the lease: others may still send there.
  [[nodiscard]] std::optional<GroupIndex> last_group(CellId cell) const noexcept;
  /// Cell and group of a beacon during the lease; group 0: the base group.
  [[nodiscard]] std::optional<pdu::CellGroup> find_beacon(
      std::uint32_t tag, std::chrono::nanoseconds now) const noexcept;

  /// Whether the lease is valid.
  [[nodiscard]] bool holds(std::chrono::nanoseconds now) const noexcept {
    return leader_ != 0 && now - heard_ < lease_;
  }
  /// When the lease ends or ended; the earliest representable time if no map was ever received.
  [[nodiscard]] std::chrono::nanoseconds lease_end() const noexcept {
    return leader_ == 0 ? std::chrono::nanoseconds::min() : heard_ + lease_;
  }
  /// Time without a map before the last one came; 0 for the first one.
  [[nodiscard]] std::chrono::nanoseconds pause() const noexcept { return pause_; }
  /// All entries, by cell, without regard to the lease.
  [[nodiscard]] std::span<const pdu::CellGroup> entries() const noexcept { return entries_; }
  /// All beacons, by tag, without regard to the lease.
  [[nodiscard]] std::span<const pdu::CellGroup> beacons() const noexcept { return beacons_; }
  /// Rows of groups that were in quarantine when the map was sent; see resting_row.
  [[nodiscard]] std::span<const pdu::CellGroup> resting() const noexcept { return resting_; }
  [[nodiscard]] std::uint32_t version() const noexcept { return version_; }
  /// Epoch that sent it; 0: no map was ever received.
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
  [[nodiscard]] std::size_t find(CellId cell) const noexcept;  // size of entries_ if none

  std::size_t pool_;
  std::chrono::nanoseconds lease_;
  Pending pending_;
  std::vector<pdu::CellGroup> entries_, resting_, beacons_;
  std::vector<std::chrono::nanoseconds> since_;  ///< start of each of entries_, without a pause
  std::uint32_t version_ = 0, leader_ = 0;
  std::chrono::nanoseconds heard_{}, pause_{};
  std::uint64_t refused_ = 0;
};

}  // namespace reckon::aoim
