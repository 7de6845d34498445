// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Delayed datagrams: a bounded queue ordered by due time, then by arrival. Private to the peer
// library: the common part of SimulatedNetwork and ImpairedLink.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "reckon/peer/network/link.hpp"

namespace reckon::peer {

/// Holds copies of datagrams until they are due. Everything is allocated at construction.
class DelayQueue {
 public:
  /// Room for `capacity` datagrams of up to `max_bytes` octets; pages are used as they are needed.
  DelayQueue(std::size_t capacity, std::size_t max_bytes);

  /// Copies a datagram in; false if the queue is full or the datagram is too long. O(log n).
  bool push(std::chrono::nanoseconds due, const GroupAddress& group, const IpEndpoint& sender,
            std::span<const std::byte> bytes) noexcept;
  /// Frees the datagrams that pop_due() returned before; their bytes are then invalid.
  void release() noexcept;
  /// Returns datagrams that are due at `now`, at most out.size(); Datagram::received = due time.
  std::size_t pop_due(std::chrono::nanoseconds now, std::span<Datagram> out) noexcept;

  /// When the next one is due; nanoseconds::max() if the queue is empty.
  [[nodiscard]] std::chrono::nanoseconds next_due() const noexcept;
  [[nodiscard]] std::size_t size() const noexcept { return heap_.size(); }
  [[nodiscard]] std::size_t max_bytes() const noexcept { return max_bytes_; }

 private:
  struct Entry {
    std::chrono::nanoseconds due;
    std::uint64_t order;
    std::uint32_t slot;
  };
  struct Held {
    GroupAddress group;
    IpEndpoint sender;
    std::size_t length;
  };
  // The heap's front is the earliest.
  static bool later(const Entry& a, const Entry& b) noexcept {
    return a.due != b.due ? a.due > b.due : a.order > b.order;
  }

  std::size_t max_bytes_;
  std::unique_ptr<std::byte[]> bytes_;
  std::vector<Held> held_;
  std::vector<Entry> heap_;
  std::vector<std::uint32_t> free_;
  std::vector<std::uint32_t> lent_;
  std::uint64_t pushed_{0};
};

}  // namespace reckon::peer
