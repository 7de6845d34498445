// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Opened datagrams of senders that have not proved to be live, a few for each.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>

#include "reckon/peer/network/link.hpp"
#include "reckon/peer/sealing/sealed_senders.hpp"

namespace reckon::peer {

/// A ring: the oldest is replaced first. One thread; allocates only at construction.
class HeldDatagrams {
 public:
  static constexpr std::size_t kMost = 512;         ///< of all senders
  static constexpr std::uint8_t kMostOfSender = 8;  ///< the ones that were sealed last
  static constexpr std::size_t kLongest = 1500;     ///< [octets]; longer ones are not held

  HeldDatagrams() : octets_(std::make_unique_for_overwrite<std::byte[]>(kMost * kLongest)) {}

  /// Adds a datagram. If the sender already has kMostOfSender, it replaces the earliest of these.
  /// False if the datagram replaced one of its sender, or is refused because it is even earlier or
  /// too long.
  /// @param since when its group was joined
  [[nodiscard]] bool push(SealedSender& sender, const EnvelopeHeader& header,
                          const Datagram& datagram, std::chrono::nanoseconds since) noexcept {
    if (datagram.bytes.size() > kLongest) return false;
    const Slot slot{State::held, sender.serial, header.count, header.stamp, since, datagram};
    if (sender.held == kMostOfSender) {
      const std::size_t place = earliest_of(sender);
      if (place < kMost) {
        if (slots_[place].count < slot.count) put(place, slot);
        return false;
      }
      sender.held = 0;  // all were replaced by others
    }
    ++sender.held;
    put(next_, slot);
    next_ = (next_ + 1) % kMost;
    return true;
  }

  /// For a sender that has become trusted: its timely datagrams are ready for take(), its others
  /// are discarded.
  void release(const SealedSender& sender) noexcept {
    for (Slot& slot : slots_) {
      if (slot.state != State::held || slot.serial != sender.serial) continue;
      const bool is_of_now = sender.time.is_timely(slot.stamp, slot.datagram.received, slot.since);
      slot.state = is_of_now ? State::released : State::empty;
      if (is_of_now) ++released_;
    }
  }

  [[nodiscard]] bool has_released() const noexcept { return released_ > 0; }
  /// Returns the next one in `out`, in the order of arrival, and copies its octets to `room` (at
  /// least kLongest); false if there is none.
  [[nodiscard]] bool take(Datagram& out, std::span<std::byte> room) noexcept {
    if (released_ == 0) return false;
    std::size_t first = kMost;
    const auto order = [&](std::size_t i) {
      return std::pair(slots_[i].datagram.received, slots_[i].count);
    };
    for (std::size_t i = 0; i < kMost; ++i) {
      if (slots_[i].state != State::released) continue;
      if (first == kMost || order(i) < order(first)) first = i;
    }
    Slot& slot = slots_[first];
    assert(room.size() >= slot.datagram.bytes.size());
    out = slot.datagram;
    std::copy_n(octets_of(first), slot.datagram.bytes.size(), room.begin());
    out.bytes = room.first(slot.datagram.bytes.size());
    slot.state = State::empty;
    --released_;
    return true;
  }

 private:
  enum class State : std::uint8_t { empty, held, released };
  struct Slot {
    State state{State::empty};
    std::uint64_t serial{0};  // of its sender
    std::uint64_t count{0};
    std::uint32_t stamp{0};
    std::chrono::nanoseconds since{0};
    Datagram datagram;  // its octets are in octets_
  };
  [[nodiscard]] std::byte* octets_of(std::size_t slot) noexcept {
    return octets_.get() + slot * kLongest;
  }
  [[nodiscard]] std::size_t earliest_of(const SealedSender& sender) const noexcept {
    // Place of the sender's datagram that was sealed first; kMost if there is none.
    std::size_t earliest = kMost;
    for (std::size_t i = 0; i < kMost; ++i) {
      if (slots_[i].state != State::held || slots_[i].serial != sender.serial) continue;
      if (earliest == kMost || slots_[i].count < slots_[earliest].count) earliest = i;
    }
    return earliest;
  }
  void put(std::size_t place, const Slot& slot) noexcept {
    if (slots_[place].state == State::released) --released_;
    slots_[place] = slot;
    std::ranges::copy(slot.datagram.bytes, octets_of(place));
  }

  std::array<Slot, kMost> slots_{};
  std::unique_ptr<std::byte[]> octets_;
  std::size_t next_ = 0;
  std::size_t released_ = 0;
};

}  // namespace reckon::peer
