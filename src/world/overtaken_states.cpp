// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/overtaken_states.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <limits>

#include "reckon/pdu/entity/entity_state.hpp"
#include "reckon/pdu/timestamp.hpp"

namespace reckon::peer {
namespace {

constexpr std::size_t kEntitiesPerDatagram = 8;  // average number for which the table has room
constexpr std::size_t kPlacesTried = 16;         // beyond them a state is taken as it is
constexpr std::int32_t kSecond = pdu::kTimestampUnitsPerHour / 3600;

// Offsets in an Entity State PDU (IEEE 1278.1-2012 7.2.2).
constexpr std::size_t kParametersAt = 19, kAppearanceAt = 84;
constexpr std::size_t kFixed = pdu::kFixedSize<pdu::EntityState>;

// Datagrams prefetched in advance: another core has written them, and hardware prefetchers do not
// read backwards.
constexpr std::size_t kAhead = 3;
constexpr std::size_t kCacheLine = 64;  // of a processor's cache [octets]

void bring_near(std::span<const std::byte> octets) {
  for (std::size_t at = 0; at < octets.size(); at += kCacheLine) __builtin_prefetch(&octets[at]);
}

bool same_sender(const Arrival& a, const Arrival& b) {
  return a.epoch == b.epoch && a.from == b.from && a.group == b.group;
}

// Whether decoding would find a whole state.
bool is_whole_state(std::span<const std::byte> octets) {
  if (octets.size() < kFixed) return false;
  const auto parameters = std::to_integer<std::size_t>(octets[kParametersAt]);
  return kFixed + parameters * pdu::kFixedSize<pdu::VariableParameter> <= octets.size();
}

}  // namespace

OvertakenStates::OvertakenStates(std::uint8_t exercise, std::size_t datagrams, bool bodies_in_part)
    : exercise_(exercise),
      bodies_in_part_(bodies_in_part),
      found_(datagrams),
      newest_(std::bit_ceil(kEntitiesPerDatagram * std::max<std::size_t>(datagrams, 1))),
      shift_(64 - std::countr_zero(newest_.size())) {
  assert(datagrams <= std::numeric_limits<std::uint16_t>::max());
  senders_.reserve(kMostSenders);
}

void OvertakenStates::begin_look() noexcept {
  count_ = 0;
  senders_.clear();
  if (++look_ == 0) {  // once in 65,536 looks
    std::fill(newest_.begin(), newest_.end(), Newest());
    look_ = 1;
  }
}

// Goes from the last to the first, so that a state found later is always overtaken.
void OvertakenStates::look(std::span<const ArrivedDatagram> datagrams) noexcept {
  assert(datagrams.size() <= found_.size());
  begin_look();
  for (std::size_t i = datagrams.size(); i-- > 0;) {
    if (i >= kAhead) bring_near(datagrams[i - kAhead].octets);
    Found& found = found_[i];
    found = {0, sender_of(datagrams[i].arrival), false};
    for (const pdu::BundledPdu& pdu : pdu::BundleReader(datagrams[i].octets)) {
      const bool looks = pdu.index < kMostPdus && found.sender != kNoSender;
      const Pdu verdict = looks ? look_at(pdu, i) : Pdu::more;
      if (verdict == Pdu::more) found.has_more = true;
      if (!looks) break;
      if (verdict != Pdu::overtaken) continue;
      found.overtaken |= std::uint64_t{1} << pdu.index;
      ++count_;
    }
  }
}

// Most datagrams have the sender of another one.
std::uint16_t OvertakenStates::sender_of(const Arrival& arrival) noexcept {
  const auto known = std::find_if(senders_.begin(), senders_.end(), [&](const Arrival* sender) {
    return same_sender(*sender, arrival);
  });
  if (known != senders_.end()) return static_cast<std::uint16_t>(known - senders_.begin());
  if (senders_.size() == kMostSenders) return kNoSender;
  senders_.push_back(&arrival);  // within the capacity of construction
  return static_cast<std::uint16_t>(senders_.size() - 1);
}

OvertakenStates::Pdu OvertakenStates::look_at(const pdu::BundledPdu& pdu,
                                              std::size_t datagram) noexcept {
  if (pdu.error != pdu::DecodeError::none || pdu.header.exercise_id != exercise_) return Pdu::more;
  if (pdu.header.pdu_type == pdu::PduType::datagram_trailer) return Pdu::nothing;
  pdu::EntityId entity;
  const bool is_state = pdu.header.pdu_type == pdu::PduType::entity_state &&
                        is_whole_state(pdu.bytes) &&
                        pdu::load_record(pdu.bytes.subspan(pdu::kHeaderSize), entity);
  if (!is_state) return Pdu::more;
  const std::uint64_t key = entity.key() << 16 | found_[datagram].sender;
  Newest* const newest = find(key);
  if (newest == nullptr) return Pdu::more;
  const std::uint32_t timestamp = pdu.header.timestamp;
  if (newest->look != look_) {
    *newest = {key, timestamp, look_, static_cast<std::uint16_t>(datagram)};
    return Pdu::more;
  }
  const std::int32_t older = pdu::difference_units(newest->timestamp, timestamp);
  const bool overtaken =
      newest->datagram != datagram && is_plain(pdu) && older > 0 && older < kSecond;
  return overtaken ? Pdu::overtaken : Pdu::more;
}

// True if a later state has all information of this one.
bool OvertakenStates::is_plain(const pdu::BundledPdu& pdu) const noexcept {
  const auto appearance = pdu::load_big_endian<std::uint32_t>(pdu.bytes.data() + kAppearanceAt);
  const bool has_parts = pdu.bytes[kParametersAt] != std::byte{0};
  return !pdu.header.coupled_extension() && !(bodies_in_part_ && has_parts) &&
         (appearance & pdu::kAppearanceDeactivated) == 0;
}

// Place of the newest state of this key, or a free place; null if too many other keys occupy the
// tried places.
OvertakenStates::Newest* OvertakenStates::find(std::uint64_t key) noexcept {
  auto place = static_cast<std::size_t>((key * 0x9E3779B97F4A7C15ULL) >> shift_);
  for (std::size_t i = 0; i < kPlacesTried; ++i, place = (place + 1) & (newest_.size() - 1)) {
    Newest& found = newest_[place];
    if (found.look != look_ || found.key == key) return &found;
  }
  return nullptr;
}

}  // namespace reckon::peer
