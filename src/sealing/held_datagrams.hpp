// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What senders said before it was known that they are of today: a few datagrams each, opened.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "reckon/peer/network/link.hpp"
#include "reckon/peer/sealing/envelope.hpp"

namespace reckon::peer {

/// A ring: the oldest goes first. One thread; allocates at construction alone.
class HeldDatagrams {
 public:
  static constexpr std::size_t kMost = 512;         ///< of all senders
  static constexpr std::uint8_t kMostOfSender = 8;  ///< the first ones, which say who it is
  static constexpr std::size_t kLongest = 1500;     ///< [octets]; longer ones are not held

  HeldDatagrams();

  /// False where it is too long. @param count of its stream
  [[nodiscard]] bool push(const Sealer& sealer, std::uint64_t count,
                          const Datagram& datagram) noexcept;

  /// Those of this sender that arrived after `since` and have a count above `floor` may be taken
  /// from now on; its others are forgotten.
  void release(const Sealer& sealer, std::uint64_t floor, std::chrono::nanoseconds since) noexcept;

  [[nodiscard]] bool has_released() const noexcept { return released_ > 0; }
  /// The next one in `out`, its octets copied to `room` (at least kLongest); false where there is
  /// none.
  [[nodiscard]] bool take(Datagram& out, std::span<std::byte> room) noexcept;

 private:
  enum class State : std::uint8_t { empty, held, released };
  struct Slot {
    State state{State::empty};
    Sealer sealer;
    std::uint64_t count{0};
    Datagram datagram;  // its octets lie in octets_
  };
  [[nodiscard]] std::byte* octets_of(std::size_t slot) noexcept {
    return octets_.get() + slot * kLongest;
  }

  std::array<Slot, kMost> slots_{};
  std::unique_ptr<std::byte[]> octets_;
  std::size_t next_ = 0;
  std::size_t released_ = 0;
};

}  // namespace reckon::peer
