// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/sender_budget.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "reckon/pdu/random/split_mix.hpp"

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

// Hash of all fields that distinguish an endpoint.
std::uint64_t hash_of(const IpEndpoint& who) noexcept {
  std::uint64_t high = 0, low = 0;
  std::memcpy(&high, who.octets.data(), sizeof high);
  std::memcpy(&low, who.octets.data() + sizeof high, sizeof low);
  return pdu::mixed_bits(high ^ (low * pdu::kGoldenStep) ^ (std::uint64_t{who.port} << 48));
}

}  // namespace

bool SenderBudget::admit(const IpEndpoint& sender, nanoseconds received, bool pressed) noexcept {
  const std::uint64_t hash = hash_of(sender);
  Known* const known = find_known(sender, hash);
  Source* const source = known != nullptr ? &known->source : find(sender, hash, received);
  // Datagrams of a muted source do not count against the others of its host.
  if (!count(source, received, pressed ? kMostPressed : kMost)) return false;
  const std::uint32_t most = pressed ? kMostOfAddressPressed : kMostOfAddress;
  if (known != nullptr && known->source.count <= most / known->sharers) return true;
  IpEndpoint address = sender;
  address.port = 0;
  return count(find(address, hash_of(address), received), received, most);
}

SenderBudget::Known* SenderBudget::find_known(const IpEndpoint& who, std::uint64_t hash) noexcept {
  if (known_count_ == 0) return nullptr;
  for (std::size_t at = hash % kSlots; slots_[at] != 0; at = (at + 1) % kSlots) {
    Known& known = known_[slots_[at] - 1u];
    if (known.source.who == who) return &known;
  }
  return nullptr;
}

// Removes the source from its entry, so that its count and muting can be moved to a new one.
SenderBudget::Source SenderBudget::take_out(const IpEndpoint& who) noexcept {
  for (Source& source : sources_[hash_of(who) % kSets]) {
    if (source.window >= nanoseconds(0) && source.who == who) return std::exchange(source, {});
  }
  Source fresh;
  fresh.who = who;
  fresh.window = nanoseconds(0);
  return fresh;
}

void SenderBudget::know(const KnownSources& known) noexcept {
  const std::size_t count_before = known_count_;
  std::copy_n(known_.begin(), count_before, before_.begin());
  known_count_ = 0;
  std::size_t old = 0;
  for (const IpEndpoint& who : known.all()) {
    // Both lists are in the same order.
    while (old < count_before && before_[old].source.who < who) forget(before_[old++]);
    const bool stays = old < count_before && before_[old].source.who == who;
    known_[known_count_++].source = stays ? before_[old++].source : take_out(who);
  }
  while (old < count_before) forget(before_[old++]);
  slots_.fill(0);
  for (std::size_t i = 0; i < known_count_; ++i) {
    const IpEndpoint& who = known_[i].source.who;
    const auto same = std::ranges::equal_range(known.all(), who.octets, {}, &IpEndpoint::octets);
    known_[i].sharers = static_cast<std::uint32_t>(same.size());
    std::size_t at = hash_of(who) % kSlots;
    while (slots_[at] != 0) at = (at + 1) % kSlots;
    slots_[at] = static_cast<std::uint16_t>(i + 1);
  }
}

// It counts as a source of its host again, from zero.
void SenderBudget::forget(Known& known) noexcept {
  if (known.source.muted) report(known.source, false);
}

// The entry of a source. A new source replaces one that was silent for a window; null if all
// possible entries are in use.
SenderBudget::Source* SenderBudget::find(const IpEndpoint& who, std::uint64_t hash,
                                         nanoseconds received) noexcept {
  Source* free = nullptr;
  for (Source& source : sources_[hash % kSets]) {
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
  if (!source->muted && source->count > most) report(*source, true);
  if (source->muted) ++source->dropped;
  return !source->muted;
}

// Ends a window.
void SenderBudget::turn(Source& source, nanoseconds received) noexcept {
  if (source.muted && source.count < kCalm) report(source, false);
  source.window = received;
  source.count = 0;
}

void SenderBudget::look(nanoseconds now) noexcept {
  if (muted_ == 0) return;
  const auto forgive = [&](Source& source) {
    if (source.muted && now - source.window > 2 * kWindow) report(source, false);
  };
  for (auto& set : sources_) std::ranges::for_each(set, forgive);
  for (std::size_t i = 0; i < known_count_; ++i) forgive(known_[i].source);
}

void SenderBudget::report(Source& source, bool muted) noexcept {
  source.muted = muted;
  muted_ += muted ? 1 : std::size_t(-1);
  static_cast<void>(out_.push({source.who, muted, source.dropped}));
  source.dropped = 0;
}

}  // namespace reckon::peer
