// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/peers/claim_watch.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "reckon/pdu/bundle.hpp"

namespace reckon::fuzz {
namespace {

using aoim::PresenceEventKind;

constexpr nanoseconds kWaits = std::chrono::milliseconds(2300);  // limit for counted claimants

bool has_strangers(const Plan& plan) noexcept {
  return std::any_of(plan.faults.begin(), plan.faults.end(),
                     [](const Fault& fault) { return is_forgery(fault.kind); });
}

}  // namespace

std::optional<aoim::PeerId> announced_in(std::span<const std::byte> datagram) {
  for (const pdu::BundledPdu& bundled : pdu::BundleReader(datagram)) {
    pdu::Presence presence;
    const bool announces = bundled.error == pdu::DecodeError::none &&
                           bundled.header.pdu_type == pdu::PduType::presence &&
                           pdu::decode(bundled.bytes, presence) == pdu::DecodeError::none;
    if (announces && (presence.flags & pdu::kPresenceLeaving) == 0) return presence.simulation;
  }
  return {};
}

ClaimWatch::ClaimWatch(const Plan& plan, const std::vector<Life>& lives)
    : lives_(lives), watches_(!has_strangers(plan)) {}

void ClaimWatch::see_received(std::size_t life, const PeerDatagram& datagram, nanoseconds now) {
  if (!watches_ || !datagram.announces || datagram.sender == life) return;
  claims_[{life, datagram.sender}] = {*datagram.announces, now};
}

void ClaimWatch::see_event(std::size_t life, const aoim::PresenceEvent& event) {
  switch (event.kind) {
    case PresenceEventKind::restarted:
      ended_.insert({life, event.former_epoch});
      return;
    case PresenceEventKind::departed:
      ended_.insert({life, event.announced.epoch});
      return freed_.push_back(event.peer());
    case PresenceEventKind::timed_out:
      return freed_.push_back(event.peer());
    case PresenceEventKind::renamed:
    case PresenceEventKind::identity_changed:
      return freed_.push_back(event.former);
    default:
      return;
  }
}

// A claimant that has had no other number, so that all peers know it by this one.
bool ClaimWatch::waits(std::size_t life, std::size_t claimant, aoim::PeerId id,
                       nanoseconds now) const {
  const Life& other = lives_[claimant];
  const auto claim = claims_.find({life, claimant});
  return claim != claims_.end() && claim->second.id == id && now - claim->second.at < kWaits &&
         other.ids.size() == 1 && !other.left && !ended_.contains({life, other.epoch});
}

void ClaimWatch::look(std::size_t life, nanoseconds now, const Report& report) {
  const SimulatedPeer& peer = *lives_[life].peer;
  for (const aoim::PeerId id : freed_) {
    const auto listed = peer.aoim().presence().peers();
    const bool is_held =
        peer.id() == id || std::any_of(listed.begin(), listed.end(),
                                       [id](const aoim::Peer& other) { return other.id() == id; });
    for (std::size_t other = 0; other < lives_.size() && !is_held && watches_; ++other) {
      if (other == life || !waits(life, other, id, now)) continue;
      report(other, fmt::format("{}:{} was given up, and {:08x}, which has asked for it, goes on "
                                "waiting",
                                id.site, id.application, lives_[other].epoch));
    }
  }
  freed_.clear();
}

}  // namespace reckon::fuzz
