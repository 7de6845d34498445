// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/datagram_ring.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <type_traits>

namespace reckon::peer {
namespace {

constexpr std::size_t kLeast = std::size_t{64} << 10;
constexpr std::size_t kAlign = 64;
constexpr std::uint32_t kStartOver = 0xffffffffu;  // in place of a size

constexpr std::size_t stride(std::size_t size) {
  return (kAlign + size + kAlign - 1) / kAlign * kAlign;
}
constexpr std::size_t kLongest = stride(kMaxDatagram);

}  // namespace

// Occupies kAlign octets, so that a header fits before the end after any entry.
struct DatagramRing::Header {
  GroupAddress group;
  IpEndpoint sender;
  std::uint32_t size = 0;
  std::chrono::nanoseconds arrival{0};
  std::uint64_t boot = 0;
};

DatagramRing::DatagramRing(std::size_t octets)
    : mask_(std::bit_ceil(std::max(octets, kLeast)) - 1),
      octets_(std::make_unique_for_overwrite<std::byte[]>(mask_ + 1)) {}

DatagramRing::Header DatagramRing::header_at(std::uint64_t position) const noexcept {
  static_assert(std::is_trivially_copyable_v<Header> && sizeof(Header) <= kAlign);
  Header header;
  std::memcpy(&header, octets_.get() + (position & mask_), sizeof header);
  return header;
}

void DatagramRing::store_header(std::uint64_t position, const Header& header) noexcept {
  std::memcpy(octets_.get() + (position & mask_), &header, sizeof header);
}

bool DatagramRing::push(const GroupAddress& group, std::chrono::nanoseconds arrival,
                        std::span<const std::byte> octets, const IpEndpoint& sender,
                        std::uint64_t boot) noexcept {
  if (octets.size() > kMaxDatagram) return false;
  std::uint64_t head = head_.load(std::memory_order_relaxed);
  const std::size_t needed = stride(octets.size());
  const std::size_t skipped = to_end(head) < needed ? to_end(head) : 0;
  const std::uint64_t used = head - tail_.load(std::memory_order_acquire);
  if (used + skipped + needed > capacity()) return false;

  if (skipped > 0) store_header(head, {{}, {}, kStartOver, {}, {}});
  head += skipped;
  store_header(head, {group, sender, static_cast<std::uint32_t>(octets.size()), arrival, boot});
  std::copy(octets.begin(), octets.end(), octets_.get() + (head & mask_) + kAlign);
  head_.store(head + needed, std::memory_order_release);
  return true;
}

// A wrap-around wastes at most one entry of the greatest length.
std::size_t DatagramRing::room() const noexcept {
  const std::uint64_t used =
      head_.load(std::memory_order_relaxed) - tail_.load(std::memory_order_acquire);
  const std::size_t fitting = (capacity() - used) / kLongest;
  return fitting > 0 ? fitting - 1 : 0;
}

std::size_t DatagramRing::most() const noexcept { return capacity() / kLongest - 1; }

// Moves `position` past the entry.
QueuedDatagram DatagramRing::entry_at(std::uint64_t& position) const noexcept {
  Header header = header_at(position);
  if (header.size == kStartOver) {
    position += to_end(position);
    header = header_at(position);
  }
  const std::byte* octets = octets_.get() + (position & mask_) + kAlign;
  position += stride(header.size);
  return {header.group, header.sender, header.arrival, {octets, header.size}, header.boot};
}

const QueuedDatagram* DatagramRing::front() noexcept {
  return front(std::span(&front_, 1)) == 0 ? nullptr : &front_;
}

std::size_t DatagramRing::front(std::span<QueuedDatagram> out) noexcept {
  next_tail_ = tail_.load(std::memory_order_relaxed);
  const std::uint64_t head = head_.load(std::memory_order_acquire);
  std::size_t count = 0;
  while (count < out.size() && next_tail_ != head) out[count++] = entry_at(next_tail_);
  return count;
}

void DatagramRing::pop() noexcept { tail_.store(next_tail_, std::memory_order_release); }

}  // namespace reckon::peer
