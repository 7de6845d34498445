// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Queue of datagrams between the model loop and the network loops.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "reckon/peer/network/link.hpp"

namespace reckon::peer {

/// A datagram in a ring.
struct QueuedDatagram {
  GroupAddress group;                   ///< source or destination
  IpEndpoint sender;                    ///< of incoming ones, as Datagram::sender
  std::chrono::nanoseconds arrival{0};  ///< our steady time; of outgoing ones 0
  std::span<const std::byte> octets{};  ///< UDP payload, valid until pop()
  std::uint64_t boot{0};                ///< of incoming ones, as Datagram::boot
};

/// Bounded queue of datagrams from exactly one writing thread to exactly one reading thread. Each
/// entry takes 64 octets more than its datagram, rounded up to 64. Wait-free on both sides. The
/// memory is reserved at construction and committed by the system at first use.
class DatagramRing {
 public:
  /// @param octets rounded up to a power of two, at least 64 KiB.  @throws std::bad_alloc.
  explicit DatagramRing(std::size_t octets);

  /// Writer: copies a datagram; false if there is no room or it is longer than kMaxDatagram.
  bool push(const GroupAddress& group, std::chrono::nanoseconds arrival,
            std::span<const std::byte> octets, const IpEndpoint& sender = {},
            std::uint64_t boot = 0) noexcept;
  /// Writer: number of datagrams of any length that fit.
  [[nodiscard]] std::size_t room() const noexcept;
  /// room() of an empty ring.
  [[nodiscard]] std::size_t most() const noexcept;

  /// Reader: the oldest datagram, or nullptr if there is none.
  [[nodiscard]] const QueuedDatagram* front() noexcept;
  /// Reader: the oldest datagrams, as many as `out` can hold; returns their number.
  std::size_t front(std::span<QueuedDatagram> out) noexcept;
  /// Frees the room of all datagrams of the last front().
  void pop() noexcept;

  /// Any thread.
  [[nodiscard]] bool empty() const noexcept {
    return head_.load(std::memory_order_acquire) == tail_.load(std::memory_order_acquire);
  }
  [[nodiscard]] std::size_t capacity() const noexcept { return mask_ + 1; }  ///< [octets]

 private:
  struct Header;
  [[nodiscard]] QueuedDatagram entry_at(std::uint64_t& position) const noexcept;
  [[nodiscard]] Header header_at(std::uint64_t position) const noexcept;
  void store_header(std::uint64_t position, const Header& header) noexcept;
  // Octets from a position to the end of the memory; a longer entry is written at its start.
  [[nodiscard]] std::size_t to_end(std::uint64_t position) const noexcept {
    return capacity() - (position & mask_);
  }

  std::size_t mask_;
  std::unique_ptr<std::byte[]> octets_;
  alignas(64) std::atomic<std::uint64_t> head_{0};  // octets written since the start
  alignas(64) std::atomic<std::uint64_t> tail_{0};  // octets freed since the start
  std::uint64_t next_tail_ = 0;                     // used by the reader, set by front()
  QueuedDatagram front_;
};

}  // namespace reckon::peer
