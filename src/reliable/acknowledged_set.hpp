// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The sender's side of assured delivery: records in flight, and the addressees that have not
// acknowledged them. Repeats are dense at first, because they repair a felt event, and end after
// five seconds.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "reckon/aoim/groups/epoch_index.hpp"
#include "reckon/pdu/reckon/assured_record.hpp"
#include "reckon/peer/reliable/assured_report.hpp"

namespace reckon::peer {

/// A record to send.
struct AssuredContent {
  pdu::AssuredKind kind = pdu::AssuredKind::record;
  std::uint8_t flags = 0;             ///< as in pdu::AssuredRecord
  std::span<const std::byte> octets;  ///< at most pdu::kMostAssured
  std::uint64_t tag = 0;              ///< for the sender, returned in each report
};

/// One transmission that is due.
struct DueRecord {
  std::uint32_t sequence = 0;
  AssuredContent content;                  ///< a view of the set, valid until its next call
  std::span<const std::uint32_t> missing;  ///< epochs of the addressees that lack it; likewise
  bool is_first = false;                   ///< not a repeat
  std::uint16_t predecessor_distance = 0;  ///< see pdu::AssuredRecord
  bool is_for_hosts = false;               ///< also to each addressee's own address
};

/// The records of one sender. Pure: time is passed in. One thread; allocates only at construction,
/// about 330 KiB, committed by the system at first use.
class AcknowledgedSet {
 public:
  /// Most records in flight: a record is refused while the one kMostInFlight before it is.
  static constexpr std::size_t kMostInFlight = 256;
  /// Times of the transmissions since the first; later ones follow each kLateRepeat.
  static constexpr std::array<std::chrono::milliseconds, 8> kRepeats{
      {std::chrono::milliseconds(0), std::chrono::milliseconds(3), std::chrono::milliseconds(6),
       std::chrono::milliseconds(12), std::chrono::milliseconds(24), std::chrono::milliseconds(48),
       std::chrono::milliseconds(96), std::chrono::milliseconds(192)}};
  static constexpr std::chrono::milliseconds kLateRepeat{200};
  /// From then on a record is also sent to each missing host.
  static constexpr std::chrono::milliseconds kToHosts{250};
  static constexpr std::chrono::seconds kGiveUp{5};

  /// @param peers most addressees in all  @param first sequence of the first record
  explicit AcknowledgedSet(std::size_t peers, std::uint32_t first = 1);

  /// Takes a record; its first transmission is due at once. Nothing if too many are in flight, it
  /// is too long, or it has no addressee or too many.
  /// @param addressees epochs, each once
  std::optional<std::uint32_t> add(const AssuredContent& content,
                                   std::span<const std::uint32_t> addressees,
                                   std::chrono::nanoseconds now) noexcept;
  /// Takes an acknowledgement of `peer`; one of records that were never sent is ignored.
  void acknowledge(std::uint32_t peer, std::uint32_t highest, const pdu::AssuredReceipt& receipt,
                   AssuredReports& reports) noexcept;
  /// Drops a peer that has left or fallen silent.
  void drop(std::uint32_t peer, AssuredReports& reports) noexcept;
  /// Gives up records that are too old. Call it before take_due().
  void give_up(std::chrono::nanoseconds now, AssuredReports& reports) noexcept;
  /// The next transmission that is due at `now`, oldest first; false if there is none.
  [[nodiscard]] bool take_due(std::chrono::nanoseconds now, DueRecord& due) noexcept;

  /// Time of the next transmission or give-up; nanoseconds::max() if nothing is in flight.
  [[nodiscard]] std::chrono::nanoseconds next_step() const noexcept;
  [[nodiscard]] std::size_t in_flight() const noexcept { return in_flight_; }

 private:
  using Nanoseconds = std::chrono::nanoseconds;
  struct Record {
    std::uint32_t sequence = 0;
    pdu::AssuredKind kind = pdu::AssuredKind::record;
    std::uint8_t flags = 0;
    std::uint16_t size = 0;
    std::uint32_t missing = 0;  ///< addressees; 0: not in flight
    std::uint32_t repeat = 0;   ///< number of the next transmission
    std::uint64_t tag = 0;
    Nanoseconds begun{};
  };

  [[nodiscard]] static Nanoseconds time_of(std::uint32_t repeat) noexcept;
  [[nodiscard]] Record& at(std::uint32_t sequence) noexcept {
    return records_[sequence % kMostInFlight];
  }
  [[nodiscard]] std::span<std::uint64_t> missing_of(const Record& record) noexcept;
  [[nodiscard]] bool is_missing(const Record& record, std::size_t place) noexcept;
  [[nodiscard]] std::uint16_t predecessor_distance_of(const Record& record) noexcept;
  void settle(Record& record, std::size_t place, AssuredOutcome outcome,
              AssuredReports& reports) noexcept;
  void settle_all(Record& record, AssuredOutcome outcome, AssuredReports& reports) noexcept;
  [[nodiscard]] std::size_t place_of(std::uint32_t peer) noexcept;
  [[nodiscard]] bool has_places_for(std::span<const std::uint32_t> addressees) const noexcept;
  void for_each_in_flight(auto&& visit) noexcept;

  struct Addressee {
    std::uint32_t epoch = 0;
    std::uint32_t records = 0;  ///< that it has not acknowledged; 0: the place is free
  };
  std::array<Record, kMostInFlight> records_{};
  std::unique_ptr<std::byte[]> octets_;  ///< of the records, kMostAssured each
  std::vector<std::uint64_t> missing_;   ///< a bit for each addressee of each record
  std::vector<Addressee> addressees_;
  std::vector<std::uint32_t> free_;     ///< places of addressees_
  std::vector<std::uint32_t> missers_;  ///< of the last DueRecord
  aoim::EpochIndex places_;
  std::size_t words_;   ///< of missing_ for a record
  std::uint32_t next_;  ///< sequence of the next record
  std::size_t in_flight_ = 0;
};

}  // namespace reckon::peer
