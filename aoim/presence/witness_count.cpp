// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/presence/witness_count.hpp"

#include <algorithm>
#include <cstdint>

namespace reckon::aoim {
namespace {

using std::chrono::nanoseconds;

// Validity of a rival's claim: one announcement period, so that a silent rival never wins. And
// validity of a witness's list: at 20 % loss all four lists of this time are lost once in 600
// times.
constexpr std::chrono::milliseconds kRecent{1200}, kRecentList{4000};
// Gap between two counts of the witnesses in a dispute.
constexpr std::chrono::milliseconds kVerdictGap{250};

}  // namespace

bool WitnessCount::is_against(const pdu::Presence& own, int excess, nanoseconds now) noexcept {
  if (now < next_) return false;
  next_ = now + kVerdictGap;
  return std::any_of(claims_.begin(), claims_.end(), [&](const Claimant& claimant) {
    return claimant.id() == own.simulation && is_won_by(claimant, own, excess, now);
  });
}

// The rival's own statements, such as its start time, count only if the witnesses are equal, so a
// forger cannot evict a peer that others receive.
bool WitnessCount::is_won_by(const Claimant& rival, const pdu::Presence& own, int excess,
                             nanoseconds now) const noexcept {
  const nanoseconds lasts = now - rival.since;
  const nanoseconds round = config_.list_round(peers_.size());
  const nanoseconds all_listed = config_.dispute + round;
  const nanoseconds least = excess > 0 ? 2 * all_listed : excess == 0 ? all_listed : all_listed / 2;
  if (!announces_established(rival.announced) || lasts < least) return false;
  if (now - rival.last_heard > kRecent) return false;
  // A peer that was cut off from us, perhaps with the rival, has to receive us before its list
  // contains us.
  const bool any_is_back = std::ranges::any_of(peers_, [&](const Peer& peer) {
    return peer.tip.is_chained() && now - peer.back_since < config_.dispute / 2;
  });
  if (any_is_back) return false;
  const std::uint32_t theirs = rival.epoch();
  const nanoseconds since = now - kRecentList - round;
  const auto names_us = [since](const Hearing& hears) { return hears.us_at > since && hears.us; };
  const auto names_rival = [since, theirs](const Hearing& hears) {
    return hears.rival_at > since && hears.rival == theirs;
  };
  const Support mine =
      support([&](const Hearing& hears, std::uint32_t) { return names_us(hears); });
  const Support other = support([&](const Hearing& hears, std::uint32_t witness) {
    return names_rival(hears) && witness != theirs;
  });
  // Whether a received peer has listed neither of us and will: a newcomer, or one that was cut off.
  // A peer that never sends a list is no witness.
  const bool awaited = std::any_of(peers_.begin(), peers_.end(), [&](const Peer& peer) {
    const bool lists = peer.hears.came > since || now - peer.first_heard <= config_.established;
    return peer.joined && peer.confirmed && lists && now - peer.last_heard <= config_.listed &&
           !names_us(peer.hears) && !names_rival(peer.hears);
  });
  if (lasts < all_listed) return !awaited && mine < other;
  return mine != other ? mine < other : !awaited && precedes(rival.announced, own);
}

WitnessCount::Support WitnessCount::support(const auto& names) const noexcept {
  Support sum;
  const std::size_t count = peers_.size() + claims_.size();
  const auto source_of_witness = [&](std::size_t i) -> const SourceAddress* {
    if (i < peers_.size())
      return names(peers_[i].hears, peers_.epoch(i)) ? &peers_[i].source : nullptr;
    const Claimant& claimant = claims_[i - peers_.size()];
    return names(claimant.hears, claimant.epoch()) ? &claimant.source : nullptr;
  };
  for (std::size_t i = 0; i < count; ++i) {
    const SourceAddress* source = source_of_witness(i);
    if (source == nullptr) continue;
    ++sum.peers;
    bool again = false;
    for (std::size_t j = 0; j < i && !again; ++j) {
      const SourceAddress* other = source_of_witness(j);
      again = other != nullptr && other->octets == source->octets;
    }
    if (!again) ++sum.addresses;
  }
  return sum;
}

nanoseconds WitnessCount::next_step(PeerId own) const noexcept {
  nanoseconds next = nanoseconds::max();
  for (const Claimant& claimant : claims_) {
    if (claimant.id() != own) continue;
    next = std::min(next, std::max(next_, claimant.since + config_.dispute / 2));
  }
  return next;
}

}  // namespace reckon::aoim
