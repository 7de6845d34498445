// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Delayed datagrams: a bounded queue ordered by due time, then by arrival. Private to the peer
// library: the common part of SimulatedNetwork and ImpairedLink.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <vector>

#include "reckon/peer/network/link.hpp"

namespace reckon::peer {

/// Holds copies of datagrams until they are due. Everything is allocated at construction.
class DelayQueue {
 public:
  /// Room for `capacity` datagrams of up to `max_bytes` octets; pages are used as they are needed.
  DelayQueue(std::size_t capacity, std::size_t max_bytes)
      : max_bytes_(max_bytes),
        bytes_(std::make_unique_for_overwrite<std::byte[]>(capacity * max_bytes)),
        held_(capacity) {
    heap_.reserve(capacity);
    free_.reserve(capacity);
    lent_.reserve(capacity);
    for (std::size_t i = capacity; i > 0; --i) free_.push_back(static_cast<std::uint32_t>(i - 1));
  }

  /// Copies a datagram in; false if the queue is full or the datagram is too long. O(log n).
  bool push(std::chrono::nanoseconds due, const GroupAddress& group, const IpEndpoint& sender,
            std::span<const std::byte> bytes) noexcept {
    if (free_.empty() || bytes.size() > max_bytes_) return false;
    const std::uint32_t slot = free_.back();
    free_.pop_back();
    held_[slot] = {group, sender, bytes.size()};
    if (!bytes.empty()) std::memcpy(&bytes_[slot * max_bytes_], bytes.data(), bytes.size());
    heap_.push_back({due, pushed_++, slot});
    std::push_heap(heap_.begin(), heap_.end(), later);
    return true;
  }
  /// Frees the datagrams that pop_due() returned before; their bytes are then invalid.
  void release() noexcept {
    free_.insert(free_.end(), lent_.begin(), lent_.end());
    lent_.clear();
  }
  /// Returns datagrams that are due at `now`, at most out.size(); Datagram::received = due time.
  std::size_t pop_due(std::chrono::nanoseconds now, std::span<Datagram> out) noexcept {
    std::size_t count = 0;
    while (count < out.size() && !heap_.empty() && heap_.front().due <= now) {
      const Entry entry = heap_.front();
      std::pop_heap(heap_.begin(), heap_.end(), later);
      heap_.pop_back();
      lent_.push_back(entry.slot);
      const Held& held = held_[entry.slot];
      const std::byte* bytes = bytes_.get() + entry.slot * max_bytes_;
      out[count++] = {held.group, held.sender, {bytes, held.length}, entry.due};
    }
    return count;
  }

  /// When the next one is due; nanoseconds::max() if the queue is empty.
  [[nodiscard]] std::chrono::nanoseconds next_due() const noexcept {
    return heap_.empty() ? std::chrono::nanoseconds::max() : heap_.front().due;
  }
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
