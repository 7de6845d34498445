// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/delay_queue.hpp"

#include <algorithm>
#include <cstring>

namespace reckon::peer {

DelayQueue::DelayQueue(std::size_t capacity, std::size_t max_bytes)
    : max_bytes_(max_bytes),
      bytes_(std::make_unique_for_overwrite<std::byte[]>(capacity * max_bytes)),
      held_(capacity) {
  heap_.reserve(capacity);
  free_.reserve(capacity);
  lent_.reserve(capacity);
  for (std::size_t i = capacity; i > 0; --i) free_.push_back(static_cast<std::uint32_t>(i - 1));
}

bool DelayQueue::push(std::chrono::nanoseconds due, const GroupAddress& group,
                      const IpEndpoint& sender, std::span<const std::byte> bytes) noexcept {
  if (free_.empty() || bytes.size() > max_bytes_) return false;
  const std::uint32_t slot = free_.back();
  free_.pop_back();
  held_[slot] = {group, sender, bytes.size()};
  if (!bytes.empty()) std::memcpy(&bytes_[slot * max_bytes_], bytes.data(), bytes.size());
  heap_.push_back({due, pushed_++, slot});
  std::push_heap(heap_.begin(), heap_.end(), later);
  return true;
}

void DelayQueue::release() noexcept {
  free_.insert(free_.end(), lent_.begin(), lent_.end());
  lent_.clear();
}

std::size_t DelayQueue::pop_due(std::chrono::nanoseconds now, std::span<Datagram> out) noexcept {
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

std::chrono::nanoseconds DelayQueue::next_due() const noexcept {
  return heap_.empty() ? std::chrono::nanoseconds::max() : heap_.front().due;
}

}  // namespace reckon::peer
