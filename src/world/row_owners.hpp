// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Owners of the state table's rows: only the sender that made a row may change it. The class also
// counts the rows of each host, so that a host that invents entities cannot exclude others.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "reckon/aoim/presence/source_address.hpp"
#include "reckon/peer/world/key_index.hpp"
#include "reckon/peer/world/row_column.hpp"
#include "reckon/peer/world/state_table.hpp"

namespace reckon::peer {

/// Owners of rows, parallel to the state table. A sender is an address with a port, or a boot in a
/// sealed exercise. A host is an address with any port; for a boot, its first address. One
/// thread; no allocation after construction.
class RowOwners {
 public:
  /// Most senders that have rows at a time; one host may be half of them.
  static constexpr std::size_t kSenders = 4096;
  /// A row never goes to another sender before its own sender was silent for this time.
  static constexpr std::chrono::nanoseconds kSilence = std::chrono::seconds(3);
  /// Upper limit of that time for a row of a plain DIS guest, whose heartbeats are rare.
  static constexpr std::chrono::nanoseconds kGuestSilence = std::chrono::seconds(12);

  /// Longest silence of a guest that still owns an entity with this time-out [s]. A guest announces
  /// itself only by heartbeats, and more than two of them fit the time-out. On the other hand, a
  /// guest that restarts with another port must not be excluded for a minute.
  [[nodiscard]] static std::chrono::nanoseconds patience_with_guest(double timeout) noexcept;

  /// @param rows most rows of the table.
  explicit RowOwners(std::size_t rows);

  /// Records a datagram from this address. Some ns.
  void heard(const aoim::SourceAddress& from, std::chrono::nanoseconds now) noexcept;

  /// Adds a row of this sender at the end. Returns false and adds none if there are too many
  /// senders.  @param guest of a plain DIS program, not of a peer
  bool push(const aoim::SourceAddress& from, bool guest, std::chrono::nanoseconds now) noexcept;
  /// Moves the last row to `place`.
  void erase(std::size_t place) noexcept;
  /// Gives the row at `place` to another owner. Returns false and changes nothing under the
  /// conditions of push().
  bool hand_over(std::size_t place, const aoim::SourceAddress& to,
                 std::chrono::nanoseconds now) noexcept;

  /// Prefetches the memory that owner(place) reads.
  void prefetch(std::size_t place) const noexcept { rows_.prefetch(place); }
  [[nodiscard]] const aoim::SourceAddress& owner(std::size_t place) const noexcept {
    return senders_[rows_[place].sender].address;
  }
  /// The owner's numbers among the present owners.
  [[nodiscard]] Party party(std::size_t place) const noexcept {
    const Row& row = rows_[place];
    return {static_cast<std::uint16_t>(senders_[row.sender].host), row.sender, row.guest};
  }
  /// Time of the last datagram from the owner.
  [[nodiscard]] std::chrono::nanoseconds last_heard(std::size_t place) const noexcept {
    return senders_[rows_[place].sender].last_heard;
  }

  /// The row to drop so that this sender gets one in a full table. A peer's row replaces a guest's
  /// row, of the host with the most guest rows. Any row replaces one of a host with more than half
  /// of the table, but a guest's row never replaces a peer's. Nothing if its own host has half, or
  /// no host has too many. Examines at most kLooks rows, from the end of the last search.
  [[nodiscard]] std::optional<std::size_t> row_to_give_up(const aoim::SourceAddress& to,
                                                          bool guest) noexcept;
  /// The guest's row to drop so that this sender gets one more when guests have reached their
  /// limit: a row of the host with the most of them. Nothing if its own host has at least as many
  /// except one. Examines the same number of rows.
  [[nodiscard]] std::optional<std::size_t> guest_to_give_up(const aoim::SourceAddress& to) noexcept;
  /// Rows of guests.
  [[nodiscard]] std::size_t guests() const noexcept { return guests_; }

 private:
  static constexpr std::size_t kLooks = 4096;
  static constexpr std::uint32_t kNone = KeyIndex::kNone;
  struct Row {
    std::uint16_t sender = 0;  // in senders_
    bool guest = false;
  };
  struct Host {
    std::array<std::uint8_t, 16> address{};
    std::size_t senders = 0, rows = 0, guests = 0;  // guests: their rows
  };
  struct Sender {
    aoim::SourceAddress address;
    std::chrono::nanoseconds last_heard{0};
    std::uint64_t key = 0;
    std::uint32_t host = 0;
    std::size_t rows = 0;
  };

  [[nodiscard]] std::uint32_t find(const aoim::SourceAddress& from) const noexcept;
  [[nodiscard]] std::uint32_t find_or_add(const aoim::SourceAddress& from,
                                          std::chrono::nanoseconds now) noexcept;
  [[nodiscard]] std::uint32_t free_place() noexcept;
  [[nodiscard]] std::uint32_t find_host(const aoim::SourceAddress& from) const noexcept;
  [[nodiscard]] std::uint32_t host_of(const aoim::SourceAddress& from) noexcept;
  [[nodiscard]] std::uint32_t crowded_host(bool guest) const noexcept;
  void give(std::uint32_t sender, bool guest) noexcept;
  void take(const Row& row) noexcept;
  [[nodiscard]] std::optional<std::size_t> next_of(std::uint32_t host, bool guests_alone) noexcept;

  RowColumn<Row> rows_;
  std::vector<Sender> senders_;      // at most kSenders
  std::vector<std::uint16_t> free_;  // unused places in senders_
  KeyIndex index_;                   // of senders_
  std::vector<Host> hosts_;          // hosts without senders are free
  std::size_t cursor_ = 0;           // in rows_
  std::size_t guests_ = 0;
};

}  // namespace reckon::peer
