// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/datagram_tap.hpp"

#include "reckon/pdu/reckon/datagram_trailer.hpp"

namespace reckon::peer {
namespace {

constexpr std::array<std::string_view, kFates> kFateNames{
    "numbered",       "sent",        "held_back",      "send_error",   "write_overflow",
    "stale_unsent",   "withheld",    "copied_to_list", "to_nobody",    "sealed",
    "unsealable",     "joined",      "left",           "kernel_drops", "arrived",
    "copied_by_law",  "lost_by_law", "queue_overflow", "not_listened", "opened",
    "held",           "greeting",    "not_opened",     "unread",       "stale",
    "muted",          "refused",     "too_long",       "delivered",    "own",
    "not_joined",     "other_scene", "former_life",    "duplicate",    "too_old",
    "other_exercise", "impostor",    "stranger",       "unicast"};
static_assert(!kFateNames.back().empty());

}  // namespace

std::string_view name(DatagramFate fate) noexcept {
  return kFateNames[static_cast<std::size_t>(fate)];
}

DatagramEvent DatagramTap::event_of(DatagramFate fate, const GroupAddress& group,
                                    std::span<const std::byte> octets) const noexcept {
  DatagramEvent event;
  event.group = group;
  event.fate = fate;
  if (envelope_number_ != nullptr && envelope_number_(octets, event)) return event;
  if (octets.size() < pdu::kDatagramTrailerSize) return event;
  pdu::DatagramTrailer trailer;
  const auto error = pdu::decode(octets.last(pdu::kDatagramTrailerSize), trailer);
  if (error != pdu::DecodeError::none || trailer.header.length != pdu::kDatagramTrailerSize)
    return event;
  event.epoch = trailer.epoch;
  event.sequence = trailer.sequence;
  return event;
}

DatagramTap::DatagramTap(std::size_t events)
    : rings_{haptics::SpscRing<DatagramEvent>(events), haptics::SpscRing<DatagramEvent>(events),
             haptics::SpscRing<DatagramEvent>(events)} {}

void DatagramTap::push(Loop loop, const DatagramEvent& event) noexcept {
  static_cast<void>(rings_[static_cast<std::size_t>(loop)].push(event));
}

bool DatagramTap::pop(DatagramEvent& event) noexcept {
  for (haptics::SpscRing<DatagramEvent>& ring : rings_) {
    if (ring.pop(event)) return true;
  }
  return false;
}

std::uint64_t DatagramTap::missed() const noexcept {
  std::uint64_t missed = 0;
  for (const haptics::SpscRing<DatagramEvent>& ring : rings_) missed += ring.refused();
  return missed;
}

}  // namespace reckon::peer
