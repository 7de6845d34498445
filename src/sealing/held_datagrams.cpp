// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/sealing/held_datagrams.hpp"

#include <algorithm>
#include <cassert>

namespace reckon::peer {

HeldDatagrams::HeldDatagrams()
    : octets_(std::make_unique_for_overwrite<std::byte[]>(kMost * kLongest)) {}

bool HeldDatagrams::push(const Sealer& sealer, std::uint64_t count,
                         const Datagram& datagram) noexcept {
  if (datagram.bytes.size() > kLongest) return false;
  Slot& slot = slots_[next_];
  if (slot.state == State::released) --released_;
  slot.state = State::held;
  slot.sealer = sealer;
  slot.count = count;
  slot.datagram = datagram;
  std::ranges::copy(datagram.bytes, octets_of(next_));
  next_ = (next_ + 1) % kMost;
  return true;
}

void HeldDatagrams::release(const Sealer& sealer, std::uint64_t floor,
                            std::chrono::nanoseconds since) noexcept {
  for (Slot& slot : slots_) {
    if (slot.state != State::held || slot.sealer != sealer) continue;
    const bool is_recent = slot.datagram.received >= since && slot.count > floor;
    slot.state = is_recent ? State::released : State::empty;
    if (is_recent) ++released_;
  }
}

bool HeldDatagrams::take(Datagram& out, std::span<std::byte> room) noexcept {
  for (std::size_t i = 0; released_ > 0 && i < kMost; ++i) {
    const std::size_t place = (next_ + i) % kMost;  // the oldest first
    Slot& slot = slots_[place];
    if (slot.state != State::released) continue;
    assert(room.size() >= slot.datagram.bytes.size());
    out = slot.datagram;
    std::copy_n(octets_of(place), slot.datagram.bytes.size(), room.begin());
    out.bytes = room.first(slot.datagram.bytes.size());
    slot.state = State::empty;
    --released_;
    return true;
  }
  return false;
}

}  // namespace reckon::peer
