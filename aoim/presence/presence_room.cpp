// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The half of presence that keeps the table of peers from being filled with names that nobody
// bears.
#include <algorithm>

#include "reckon/aoim/presence/presence.hpp"

namespace reckon::aoim {
namespace {

// A peer announces itself again within this time; one that does not may go for another.
constexpr std::chrono::milliseconds kConfirmation{300};
// A peer tells whom it hears once a second; one that has not by now is none, or of another scene.
constexpr std::chrono::milliseconds kTells{3000};

}  // namespace

// One process has one id. Reported once for each source, as long as it is remembered.
bool Presence::is_crowd(const SourceAddress& from) {
  if (from.port == 0) return false;
  std::size_t of_process = 0, of_address = 0;
  const auto count = [&](const SourceAddress& source) {
    if (source.port == 0 || source.octets != from.octets) return;
    ++of_address;
    of_process += source.port == from.port ? 1 : 0;
  };
  for (const Peer& peer : peers_) count(peer.source);
  for (const Claimant& claimant : claimants_) count(claimant.source);
  if (of_process < config_.per_source && of_address < (config_.capacity + 1) / 2) return false;
  ++counts_.crowd;
  const bool reported = std::any_of(crowds_.begin(), crowds_.end(), [&](const SourceAddress& one) {
    return one.octets == from.octets;
  });
  if (reported) return true;
  if (crowds_.size() == kCrowds) crowds_.erase(crowds_.begin());
  crowds_.push_back(from);
  events_.report(PresenceEventKind::crowd, own_).source = from;
  return true;
}

// Who announced itself once and said nothing since goes, and who never said whom it hears; of all
// these the one that came first.
bool Presence::make_room(std::chrono::nanoseconds now, const SourceAddress& from) {
  if (is_crowd(from)) return false;
  if (peers_.size() < config_.capacity) return true;
  if (now >= next_eviction_) {
    std::size_t oldest = peers_.size();
    for (std::size_t i = 0; i < peers_.size(); ++i) {
      const Peer& peer = peers_[i];
      const bool tells = peer.hears.came > std::chrono::nanoseconds::min();
      const std::chrono::nanoseconds since = now - peer.first_heard;
      if (peer.confirmed ? tells || since <= kTells : since <= kConfirmation) continue;
      if (oldest == peers_.size() || peers_[i].first_heard < peers_[oldest].first_heard) oldest = i;
    }
    if (oldest < peers_.size()) {
      remove(oldest, PresenceEventKind::timed_out);
      return true;
    }
    next_eviction_ = now + config_.minimum_gap;
  }
  ++counts_.table_full;
  return false;
}

}  // namespace reckon::aoim
