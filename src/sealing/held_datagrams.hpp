// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Opened datagrams of senders that have not proved to be live, a few for each.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "reckon/peer/network/link.hpp"
#include "reckon/peer/sealing/sealed_senders.hpp"

namespace reckon::peer {

/// A ring: the oldest is replaced first. One thread; allocates only at construction.
class HeldDatagrams {
 public:
  static constexpr std::size_t kMost = 512;         ///< of all senders
  static constexpr std::uint8_t kMostOfSender = 8;  ///< the ones that were sealed last
  static constexpr std::size_t kLongest = 1500;     ///< [octets]; longer ones are not held

  HeldDatagrams();

  /// Adds a datagram. If the sender already has kMostOfSender, it replaces the earliest of these.
  /// False if the datagram replaced one of its sender, or is refused because it is even earlier or
  /// too long.
  /// @param since when its group was joined
  [[nodiscard]] bool push(SealedSender& sender, const EnvelopeHeader& header,
                          const Datagram& datagram, std::chrono::nanoseconds since) noexcept;

  /// For a sender that has become trusted: its timely datagrams are ready for take(), its others
  /// are discarded.
  void release(const SealedSender& sender) noexcept;

  [[nodiscard]] bool has_released() const noexcept { return released_ > 0; }
  /// Returns the next one in `out`, in the order of arrival, and copies its octets to `room` (at
  /// least kLongest); false if there is none.
  [[nodiscard]] bool take(Datagram& out, std::span<std::byte> room) noexcept;

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
  [[nodiscard]] std::size_t earliest_of(const SealedSender& sender) const noexcept;
  void put(std::size_t place, const Slot& slot) noexcept;

  std::array<Slot, kMost> slots_{};
  std::unique_ptr<std::byte[]> octets_;
  std::size_t next_ = 0;
  std::size_t released_ = 0;
};

}  // namespace reckon::peer
