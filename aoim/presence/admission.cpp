// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/presence/admission.hpp"

#include <algorithm>

namespace reckon::aoim {
namespace {

// A peer announces itself again within this time; one that does not may be dropped for another.
constexpr std::chrono::milliseconds kConfirmation{300};
// A peer sends its list of received peers once a second. A sender without a list by this time is no
// peer, or belongs to another scene.
constexpr std::chrono::milliseconds kLists{3000};

}  // namespace

Admission::Admission(const PresenceConfig& config, const PeerTable& peers, const Claims& claims,
                     PresenceEvents& events)
    : config_(config), peers_(peers), claims_(claims), events_(events) {
  crowds_.reserve(kCrowds);
  reserving_.reserve(kCrowds);
}

// Whether this address was not reported yet; then it is remembered.
bool Admission::is_new(std::vector<SourceAddress>& reported, const SourceAddress& from) {
  const bool known = std::ranges::any_of(
      reported, [&](const SourceAddress& one) { return one.octets == from.octets; });
  if (known) return false;
  if (reported.size() == kCrowds) reported.erase(reported.begin());
  reported.push_back(from);
  return true;
}

bool Admission::is_reserved(const pdu::Presence& heard, const SourceAddress& from) {
  if (heard.simulation.site != kSceneSite) return false;
  ++reserved_;
  if (is_new(reserving_, from)) events_.report(PresenceEventKind::impostor, heard).other = from;
  return true;
}

// Bounds the peers of one process, which has one ID, and the peers of one address.
bool Admission::is_crowd(const SourceAddress& from, const pdu::Presence& own) {
  if (from.port == 0) return false;
  std::size_t of_process = 0, of_address = 0;
  const auto count = [&](const SourceAddress& source) {
    if (source.port == 0 || source.octets != from.octets) return;
    ++of_address;
    of_process += source.port == from.port ? 1 : 0;
  };
  for (const Peer& peer : peers_) count(peer.source);
  for (const Claimant& claimant : claims_) count(claimant.source);
  if (of_process < config_.per_source && of_address < (config_.capacity + 1) / 2) return false;
  ++refused_;
  if (is_new(crowds_, from)) events_.report(PresenceEventKind::crowd, own).source = from;
  return true;
}

std::optional<std::size_t> Admission::stale_row(std::chrono::nanoseconds now) noexcept {
  if (now < next_eviction_) return {};
  std::optional<std::size_t> oldest;
  for (std::size_t i = 0; i < peers_.size(); ++i) {
    const Peer& peer = peers_[i];
    const bool lists = peer.hears.came > std::chrono::nanoseconds::min();
    const std::chrono::nanoseconds since = now - peer.first_heard;
    if (peer.confirmed ? lists || since <= kLists : since <= kConfirmation) continue;
    if (!oldest || peer.first_heard < peers_[*oldest].first_heard) oldest = i;
  }
  if (!oldest) next_eviction_ = now + config_.minimum_gap;
  return oldest;
}

}  // namespace reckon::aoim
