// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/sealing/held_datagrams.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace reckon::peer {

HeldDatagrams::HeldDatagrams()
    : octets_(std::make_unique_for_overwrite<std::byte[]>(kMost * kLongest)) {}

// Place of the sender's datagram that was sealed first; kMost if there is none.
std::size_t HeldDatagrams::earliest_of(const SealedSender& sender) const noexcept {
  std::size_t earliest = kMost;
  for (std::size_t i = 0; i < kMost; ++i) {
    if (slots_[i].state != State::held || slots_[i].serial != sender.serial) continue;
    if (earliest == kMost || slots_[i].count < slots_[earliest].count) earliest = i;
  }
  return earliest;
}

void HeldDatagrams::put(std::size_t place, const Slot& slot) noexcept {
  if (slots_[place].state == State::released) --released_;
  slots_[place] = slot;
  std::ranges::copy(slot.datagram.bytes, octets_of(place));
}

bool HeldDatagrams::push(SealedSender& sender, const EnvelopeHeader& header,
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

void HeldDatagrams::release(const SealedSender& sender) noexcept {
  for (Slot& slot : slots_) {
    if (slot.state != State::held || slot.serial != sender.serial) continue;
    const bool is_of_now = sender.time.is_timely(slot.stamp, slot.datagram.received, slot.since);
    slot.state = is_of_now ? State::released : State::empty;
    if (is_of_now) ++released_;
  }
}

bool HeldDatagrams::take(Datagram& out, std::span<std::byte> room) noexcept {
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

}  // namespace reckon::peer
