// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/presence/address_proof.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/random/split_mix.hpp"

namespace reckon::aoim {
namespace {

using std::chrono::microseconds;
using std::chrono::nanoseconds;

// Uses of the one-way function for keys of MACs; numbers of links are below.
constexpr std::uint32_t kMacKeys = 0x4000'0000;
// Bound of the shortest transit, with the drift of both clocks.
constexpr std::chrono::milliseconds kClockBound{100};
constexpr std::chrono::seconds kWindow{8};

}  // namespace

ChainLink address_digest(pdu::Presence announced, const SourceAddress& source,
                         KeyedHash keyed_hash) noexcept {
  constexpr std::size_t kAddress = sizeof source.octets + sizeof source.port;
  std::array<std::byte, kAddress + pdu::kFixedSize<pdu::Presence>> octets;
  std::ranges::copy(std::as_bytes(std::span(source.octets)), octets.begin());
  pdu::store_big_endian(octets.data() + sizeof source.octets, source.port);
  announced.address_mac = {};
  static_cast<void>(pdu::encode(announced, std::span(octets).subspan(kAddress)));
  return keyed_hash({}, octets);
}

pdu::AddressMac address_mac(const ChainLink& opened, std::uint32_t slot, const ChainLink& digest,
                            const ProofFunctions& functions) noexcept {
  const ChainLink value = functions.keyed_hash(functions.one_way(opened, kMacKeys | slot),
                                               std::as_bytes(std::span(digest)));
  pdu::AddressMac mac;
  std::copy_n(value.begin(), mac.size(), mac.begin());
  return mac;
}

void SlotClock::raise(nanoseconds reached, nanoseconds now) noexcept {
  latest_ = std::max(latest_, reached - now);
}

void SlotClock::note(nanoseconds sent, nanoseconds arrived) noexcept {
  if (arrived - since_ > kWindow) {
    before_ = latest_;
    latest_ = kUnknown;
    since_ = arrived;
  }
  raise(sent, arrived);
}

bool SlotClock::is_running(std::uint32_t slot, nanoseconds now) const noexcept {
  return now + std::max(latest_, before_) < (slot + 1) * kSlot;
}

bool SlotClock::is_secret(std::uint32_t slot, nanoseconds now) const noexcept {
  return is_running(slot, now + kClockBound);
}

// Only the last sender of one host is kept.
AddressProof::Pending* AddressProof::place_for(const SourceAddress& from,
                                               nanoseconds now) noexcept {
  const std::span others = std::span(pending_).subspan(1);
  const auto same = std::ranges::find_if(
      others, [&](const Pending& one) { return one.from.octets == from.octets; });
  if (same != others.end()) return &*same;
  const auto free = std::ranges::find(others, 0, [](const Pending& one) { return one.from.port; });
  if (free != others.end()) return &*free;
  const std::uint64_t sent = others.size() + ++crowd_;
  const std::uint64_t drawn = pdu::split_mix(static_cast<std::uint64_t>(now.count()) + sent) % sent;
  return drawn < others.size() ? &others[drawn] : nullptr;
}

bool AddressProof::note(const pdu::Presence& heard, nanoseconds now, const SourceAddress& from,
                        bool at_home, KeyedHash keyed_hash) noexcept {
  const std::uint32_t slot = slot_of(heard.chain_number);
  clock_.raise(slot * kSlot, now);
  const bool has_mac = keyed_hash != nullptr && heard.address_mac != pdu::AddressMac{};
  if (!has_mac || from.port == 0 || from.boot != 0) return false;
  const bool in_time = clock_.is_secret(slot, now);
  const bool may_have_moved = !at_home && clock_.is_running(slot, now);
  if (!at_home && !in_time) return may_have_moved;
  Pending* place = at_home ? &pending_.front() : place_for(from, now);
  if (place == nullptr) return may_have_moved;
  const nanoseconds sent =
      slot * kSlot + std::min<nanoseconds>(microseconds(heard.slot_time), kSlot);
  *place = {from,
            heard.chain_number,
            in_time,
            address_digest(heard, from, keyed_hash),
            heard.address_mac,
            sent,
            now};
  return may_have_moved;
}

Disclosure AddressProof::disclose(const pdu::Presence& heard, const SourceAddress& bound,
                                  const ProofFunctions& functions) noexcept {
  Disclosure found;
  std::uint32_t last = 0;
  for (Pending& place : pending_) {
    const std::uint32_t slot = slot_of(place.number), opened = (slot + 1) * kSlotLinks;
    if (place.from.port == 0 || opened > heard.chain_number) continue;
    const Pending one = std::exchange(place, {});
    crowd_ = 0;
    if (opened / kChainLength != heard.chain_number / kChainLength) continue;
    const ChainLink link =
        follow_links(heard.chain_link, heard.chain_number, opened, functions.one_way);
    if (address_mac(link, slot, one.digest, functions) != one.mac) {
      if (one.from == bound) found.is_source_refuted = true;
      if (one.from != bound || found.refuted.port == 0) found.refuted = one.from;
      continue;
    }
    clock_.note(one.sent, one.arrived);
    if (!one.in_time || one.number < last) continue;
    last = one.number;
    found.proven = one.from;
    proved_ = true;
  }
  return found;
}

}  // namespace reckon::aoim
