// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Received records that wait for an earlier record of their sender. They are neither delivered nor
// acknowledged yet.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "reckon/pdu/reckon/assured_record.hpp"

namespace reckon::peer {

/// A record that waits.
struct HeldRecord {
  std::uint32_t epoch = 0;  ///< of its sender
  std::uint32_t sequence = 0;
  std::uint32_t predecessor = 0;      ///< sequence of the record that is delivered first
  std::span<const std::byte> octets;  ///< at most pdu::kMostAssured
};

/// The records of all senders. Pure: time is passed in. One thread; allocates only at construction,
/// about 600 KiB, committed by the system at first use. A call is O(held records).
class HeldRecords {
 public:
  static constexpr std::size_t kMost = 512;
  static constexpr std::size_t kMostOfSender = 128;
  /// Longest hold; longer than the time-out of the sender.
  static constexpr std::chrono::seconds kLongestHold{6};

  HeldRecords();

  /// Stores a copy of a record. If it is already held, only its predecessor changes.
  /// @return its place, constant while it is held; kMost if full, empty or too long
  std::size_t hold(const HeldRecord& record, std::chrono::nanoseconds now) noexcept;
  /// Removes a record, if it is held. For a repeat that need not wait.
  void drop(std::uint32_t epoch, std::uint32_t sequence) noexcept;
  /// Removes the records of a sender that has gone.
  void drop(std::uint32_t epoch) noexcept;
  /// Removes the records that are held for kLongestHold.
  void expire(std::chrono::nanoseconds now) noexcept;
  [[nodiscard]] bool empty() const noexcept { return used_.empty(); }

  /// Removes a record for which may_go(record) is true.
  /// @param out its octets are valid until the next call of hold()  @return its place; kMost: none
  std::size_t take(auto&& may_go, HeldRecord& out) noexcept {
    for (std::size_t i = 0; i < used_.size(); ++i) {
      const std::size_t place = used_[i];
      if (!may_go(records_[place].record)) continue;
      out = records_[place].record;
      release(i);
      return place;
    }
    return kMost;
  }

 private:
  struct Place {
    HeldRecord record;
    std::chrono::nanoseconds since{};
  };

  void release(std::size_t index) noexcept;
  void release_if(auto&& ends) noexcept;

  std::vector<Place> records_;
  std::unique_ptr<std::byte[]> octets_;     // kMostAssured for each place
  std::vector<std::uint16_t> used_, free_;  // places
};

}  // namespace reckon::peer
