// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/sealing/sealed_senders.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>

namespace reckon::peer {

static_assert(std::is_trivially_destructible_v<SealedSender>);

const SealingKey* SealedSender::key_of(const EnvelopeHeader& header) const noexcept {
  const std::uint64_t salt = key_salt(header);
  for (std::size_t i = 0; i < kKeys; ++i) {
    const Kept& kept = keys[header.stream][(latest[header.stream] + i) % kKeys];
    if (kept.is_made && kept.epoch == header.epoch && kept.salt == salt) return &kept.key;
  }
  return nullptr;
}

void SealedSender::keep(const EnvelopeHeader& header, const SealingKey& kept) noexcept {
  std::uint8_t& place = latest[header.stream];
  place = static_cast<std::uint8_t>((place + 1u) % kKeys);
  keys[header.stream][place] = {true, header.epoch, key_salt(header), kept};
}

SealedSenders::SealedSenders()
    : senders_(std::allocator<SealedSender>().allocate(kMost)),
      buckets_storage_(std::make_unique<std::array<std::uint16_t, kBuckets>>()),
      buckets_(*buckets_storage_) {
  buckets_.fill(kNone);
}

void SealedSenders::clear() noexcept {
  for (SealedSender& sender : all())
    for (auto& of_stream : sender.keys)
      for (SealedSender::Kept& kept : of_stream) kept.key.wipe();
  size_ = 0;
  buckets_.fill(kNone);
}

SealedSenders::~SealedSenders() {
  clear();
  std::allocator<SealedSender>().deallocate(senders_, kMost);
}

SealedSender* SealedSenders::find(const Sealer& sealer) noexcept {
  for (std::uint16_t at = bucket(sealer); at != kNone; at = senders_[at].next)
    if (senders_[at].sealer == sealer) return &senders_[at];
  return nullptr;
}

// The first to be replaced: an untrusted one, then the one silent for the longest.
std::size_t SealedSenders::place_for(const IpEndpoint& address) noexcept {
  std::size_t of_address = 0, worst = kMost, worst_of_address = kMost;
  const auto rank = [&](std::size_t i) {
    return std::pair(senders_[i].trusted, senders_[i].heard);
  };
  for (std::size_t i = 0; i < size_; ++i) {
    if (worst == kMost || rank(i) < rank(worst)) worst = i;
    if (senders_[i].trusted || senders_[i].address != address) continue;
    ++of_address;
    if (worst_of_address == kMost || rank(i) < rank(worst_of_address)) worst_of_address = i;
  }
  if (of_address >= kMostOfAddress) return worst_of_address;
  return size_ < kMost ? size_ : worst;
}

void SealedSenders::unlink(std::size_t index) noexcept {
  std::uint16_t* at = &bucket(senders_[index].sealer);
  while (*at != index) at = &senders_[*at].next;
  *at = senders_[index].next;
}

SealedSender& SealedSenders::add(const Sealer& sealer, const IpEndpoint& address,
                                 std::chrono::nanoseconds now) noexcept {
  const std::size_t index = place_for(address);
  if (index < size_) {
    if (senders_[index].trusted) ++trusted_dropped_;
    unlink(index);
  } else {
    ++size_;
  }
  SealedSender& sender = *std::construct_at(&senders_[index]);
  sender.sealer = sealer;
  sender.serial = ++made_;
  sender.since = sender.heard = now;
  sender.address = address;
  std::uint16_t& first = bucket(sealer);
  sender.next = std::exchange(first, static_cast<std::uint16_t>(index));
  return sender;
}

}  // namespace reckon::peer
