// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/sender_budget.hpp"

#include <cstring>

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

// Splitmix64 of all that tells an endpoint from another.
std::uint64_t hash_of(const IpEndpoint& who) noexcept {
  std::uint64_t high = 0, low = 0;
  std::memcpy(&high, who.octets.data(), sizeof high);
  std::memcpy(&low, who.octets.data() + sizeof high, sizeof low);
  std::uint64_t x = high ^ (low * 0x9e3779b97f4a7c15u) ^ (std::uint64_t{who.port} << 48);
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

}  // namespace

bool SenderBudget::admit(const IpEndpoint& sender, nanoseconds received, bool pressed) noexcept {
  IpEndpoint address = sender;
  address.port = 0;
  // What one is muted for is not laid at the door of the others of its host.
  return count(find(sender, received), received, pressed ? kMostPressed : kMost) &&
         count(find(address, received), received, pressed ? kMostOfAddressPressed : kMostOfAddress);
}

// The place of a source, that of another which was silent for a window where it has none; null
// where all places it may have are in use.
SenderBudget::Source* SenderBudget::find(const IpEndpoint& who, nanoseconds received) noexcept {
  Source* free = nullptr;
  for (Source& source : sources_[hash_of(who) % kSets]) {
    if (source.window >= nanoseconds(0) && source.who == who) return &source;
    const bool idle = source.window < nanoseconds(0) || received - source.window > 2 * kWindow;
    if (idle && !source.muted) free = &source;
  }
  if (free != nullptr) *free = {who, received, 0, false, 0};
  return free;
}

bool SenderBudget::count(Source* source, nanoseconds received, std::uint32_t most) noexcept {
  if (source == nullptr) return true;
  if (received - source->window >= kWindow) turn(*source, received);
  ++source->count;
  if (!source->muted && source->count > most) tell(*source, true);
  if (source->muted) ++source->dropped;
  return !source->muted;
}

// A window ends.
void SenderBudget::turn(Source& source, nanoseconds received) noexcept {
  if (source.muted && source.count < kCalm) tell(source, false);
  source.window = received;
  source.count = 0;
}

void SenderBudget::look(nanoseconds now) noexcept {
  if (muted_ == 0) return;
  for (auto& set : sources_) {
    for (Source& source : set) {
      if (source.muted && now - source.window > 2 * kWindow) tell(source, false);
    }
  }
}

void SenderBudget::tell(Source& source, bool muted) noexcept {
  source.muted = muted;
  muted_ += muted ? 1 : std::size_t(-1);
  static_cast<void>(told_.push({source.who, muted, source.dropped}));
  source.dropped = 0;
}

}  // namespace reckon::peer
