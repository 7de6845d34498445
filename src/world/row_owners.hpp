// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Whose the rows of the state table are: the sender that made a row is the one that may change it.
// And how many rows each host has, so that one that invents entities shuts nobody else out.
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

/// Owners of rows, beside the state table. A sender is an address with a port, in a sealed exercise
/// a boot; a host an address, whatever the port, that of a boot the one where it was heard first.
/// One thread; no allocation after construction.
class RowOwners {
 public:
  /// Senders that have rows at a time; one host may be half of them.
  static constexpr std::size_t kSenders = 4096;
  /// After so long without anything from its sender a row may be another's: at the earliest.
  static constexpr std::chrono::nanoseconds kSilence = std::chrono::seconds(3);
  /// The same of a guest of plain DIS, whose heartbeats are rare: at the latest.
  static constexpr std::chrono::nanoseconds kGuestSilence = std::chrono::seconds(12);

  /// How long a guest may say nothing at all and still own an entity that is owed so much silence
  /// [s]. It announces itself by nothing but heartbeats, of which more than two fit the time-out;
  /// one that starts anew from another port is not to be shut out for a minute either.
  [[nodiscard]] static std::chrono::nanoseconds patience_with_guest(double timeout) noexcept;

  /// @param rows most rows of the table.
  explicit RowOwners(std::size_t rows);

  /// Something came from there. Some ns.
  void heard(const aoim::SourceAddress& from, std::chrono::nanoseconds now) noexcept;

  /// A row more, at the end, of this sender; false, and no row, where there are too many senders.
  /// @param guest of a plain DIS program, not of a peer
  bool push(const aoim::SourceAddress& from, bool guest, std::chrono::nanoseconds now) noexcept;
  /// The last row goes to `place`.
  void erase(std::size_t place) noexcept;
  /// The row at `place` is another's from now on; false, and nothing changes, as in push().
  bool hand_over(std::size_t place, const aoim::SourceAddress& to,
                 std::chrono::nanoseconds now) noexcept;

  /// Has what owner(place) looks at brought near.
  void prefetch(std::size_t place) const noexcept { rows_.prefetch(place); }
  [[nodiscard]] const aoim::SourceAddress& owner(std::size_t place) const noexcept {
    return senders_[rows_[place].sender].address;
  }
  /// The owner among those that have rows now.
  [[nodiscard]] Party party(std::size_t place) const noexcept {
    const Row& row = rows_[place];
    return {static_cast<std::uint16_t>(senders_[row.sender].host), row.sender, row.guest};
  }
  /// Since when nothing has come from the owner.
  [[nodiscard]] std::chrono::nanoseconds last_heard(std::size_t place) const noexcept {
    return senders_[rows_[place].sender].last_heard;
  }

  /// The row that goes so that this sender may have one in a full table. A peer's takes the place
  /// of a guest's, of the host with the most of them; any takes that of a host with more than half
  /// of the table, but no guest's that of a peer's. Nothing where its own host has half, or nobody
  /// has too many. Looks at kLooks rows at most, going on where it ended.
  [[nodiscard]] std::optional<std::size_t> row_to_give_up(const aoim::SourceAddress& to,
                                                          bool guest) noexcept;
  /// The guest's row that goes so that this sender may have one more where guests may have no more
  /// in all: of the host with the most of them. Nothing where its own host has as many but one.
  /// Looks at as many rows.
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
    std::size_t senders = 0, rows = 0, guests = 0;  // guests: rows of them
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
  std::vector<std::uint16_t> free_;  // places in senders_ that nobody has
  KeyIndex index_;                   // of senders_
  std::vector<Host> hosts_;          // those without senders are free
  std::size_t cursor_ = 0;           // in rows_
  std::size_t guests_ = 0;
};

}  // namespace reckon::peer
