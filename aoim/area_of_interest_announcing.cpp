// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What the area-of-interest manager says of this peer itself on the base group: that it is here,
// and whom it hears.
#include <algorithm>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/pdu/timestamp.hpp"

namespace reckon::aoim {
namespace {

using std::chrono::nanoseconds;

constexpr std::size_t kEpochSize = pdu::kFixedSize<pdu::PeerEpoch>;
constexpr std::size_t kMostListed = 256;  // a list and its bundle stay below the payload limit

}  // namespace

void AreaOfInterestManager::announce(nanoseconds now) {
  const std::span<const pdu::Presence> outgoing = presence_.step(now);
  conclude(now);
  for (pdu::Presence announced : outgoing) {
    const bool leaves = (announced.flags & pdu::kPresenceLeaving) != 0;
    // Entities that came before we are known would be dropped.
    if (introduce_ && !leaves) introductions_.begin(kBaseGroup, {}, now);
    introduce_ = introduce_ && leaves;
    announced.send_time = static_cast<std::uint64_t>((now + utc_offset_).count());
    announced.header.timestamp = pdu::to_dis_timestamp(now + utc_offset_, synchronised_);
    std::array<std::byte, pdu::kFixedSize<pdu::Presence>> octets;
    const std::size_t size = pdu::encode(announced, octets);
    aggregator_.add(kBaseGroup, std::span(octets).first(size), now);
    if (!leaves) ask_about_joins(true, now);
  }
  announce_peers_heard(now);
}

void AreaOfInterestManager::announce_peers_heard(nanoseconds now) {
  const auto heard = presence_.take_list(now, said_);
  if (!heard) return;
  peers_heard_.resize(std::min(heard->epochs.size(), kMostListed) * kEpochSize);
  for (std::size_t i = 0; i * kEpochSize < peers_heard_.size(); ++i) {
    const std::span<std::byte> place = std::span(peers_heard_).subspan(i * kEpochSize, kEpochSize);
    static_cast<void>(pdu::store_record(pdu::PeerEpoch{heard->epochs[i]}, place));
  }
  pdu::PeersHeard list;
  list.header.exercise_id = presence_.own().header.exercise_id;
  list.header.timestamp = pdu::to_dis_timestamp(now + utc_offset_, synchronised_);
  list.simulation = presence_.id();
  list.epoch = presence_.own().epoch;
  list.continues = heard->continues;
  list.epochs = peers_heard_;
  std::array<std::byte, pdu::kFixedSize<pdu::PeersHeard> + kMostListed * kEpochSize> octets;
  const std::size_t size = pdu::encode(list, octets);
  aggregator_.add(kBaseGroup, std::span(octets).first(size), now);
}

}  // namespace reckon::aoim
