// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/presence/claims.hpp"

#include <algorithm>
#include <tuple>

namespace reckon::aoim {
namespace {

using std::chrono::nanoseconds;

// Longest delay of the last announcement of an ended epoch.
constexpr std::chrono::milliseconds kStraggler{200};
// A claim that is not settled after this is reported.
constexpr std::chrono::milliseconds kLongDispute{1000};
// Silence of the holder of an ID after which an epoch on another host gets it.
constexpr std::chrono::milliseconds kElsewhere{4500};

}  // namespace

bool precedes(const pdu::Presence& one, const pdu::Presence& other) noexcept {
  return std::tie(one.started, one.epoch) < std::tie(other.started, other.epoch);
}

bool announces_established(const pdu::Presence& heard) noexcept {
  return (heard.flags & pdu::kPresenceEstablished) != 0;
}

void Claimant::receive(const pdu::Presence& heard, nanoseconds now, const SourceAddress& from) {
  if (id() != heard.simulation) {
    since = now;
    reported = false;
  }
  announced = heard;
  last_heard = now;
  source = from;
  tip = LifeTip(heard, now);
}

Claims::Claims(const PresenceConfig& config, const PeerTable& peers, PresenceEvents& events)
    : config_(config), peers_(peers), events_(events) {
  claimants_.reserve(config.claims);
}

Claimant* Claims::find(std::uint32_t epoch) noexcept {
  const auto found = std::ranges::find(claimants_, epoch, &Claimant::epoch);
  return found == claimants_.end() ? nullptr : &*found;
}

const Claimant* Claims::find(std::uint32_t epoch) const noexcept {
  const auto found = std::ranges::find(claimants_, epoch, &Claimant::epoch);
  return found == claimants_.end() ? nullptr : &*found;
}

bool Claims::contains(PeerId id) const noexcept {
  return std::ranges::find(claimants_, id, &Claimant::id) != claimants_.end();
}

bool Claims::may_speak_for(const Claimant& claimant, const SourceAddress& from) const noexcept {
  if (may_speak(claimant.source, from)) return true;
  const std::size_t holder = peers_.find(claimant.id());
  if (holder == peers_.size() || from.boot != 0) return false;
  const auto& host = peers_[holder].source.octets;
  return host == from.octets && host != claimant.source.octets;
}

Claimant& Claims::add(const Claimant& claimant) { return claimants_.emplace_back(claimant); }

void Claims::forget(std::uint32_t epoch) noexcept {
  std::erase_if(claimants_, [epoch](const Claimant& c) { return c.epoch() == epoch; });
}

void Claims::erase(std::size_t index) noexcept {
  claimants_.erase(claimants_.begin() + static_cast<std::ptrdiff_t>(index));
}

void Claims::note_slept(nanoseconds slept, nanoseconds now) noexcept {
  const auto later = [&](nanoseconds& time) { time = std::min(time + slept, now); };
  for (Claimant& claimant : claimants_) {
    later(claimant.since);
    later(claimant.last_heard);
  }
}

// Time from which the claimant counts as a restart of the holder, if the holder remains silent.
nanoseconds Claims::restart_at(const Claimant& claimant, const Peer& holder) const noexcept {
  if (claimant.last_heard < holder.last_heard) return nanoseconds::max();  // its turn to send
  // A process restarts on the same host; a claimant elsewhere waits longer.
  const bool is_elsewhere = holder.tip.is_chained() && claimant.source.port != 0 &&
                            holder.source.port != 0 &&
                            claimant.source.octets != holder.source.octets;
  if (is_elsewhere) return std::max(claimant.since, holder.last_heard + kElsewhere);
  const bool lives = holder.last_heard > claimant.since + kStraggler;
  // A claimant that has held its ID for long is no restart either: two parts of a network have met.
  if (announces_established(claimant.announced)) {
    return std::max(claimant.since + config_.restart_wait, holder.last_heard + config_.quiet);
  }
  if (lives) return holder.last_heard + config_.quiet;
  const bool race = claimant.since - holder.first_heard < config_.established;
  return std::max(claimant.since, holder.last_heard) +
         nanoseconds(0);
}

std::optional<Claimant> Claims::settle(std::size_t index, PeerId own, nanoseconds now) {
  Claimant& claimant = claimants_[index];
  if (now - claimant.last_heard > config_.patience()) {
    erase(index);
    return {};
  }
  const bool ours = claimant.id() == own;
  const std::size_t holder = peers_.find(claimant.id());
  if (!ours && holder == peers_.size()) return {};  // free: see take_free
  if (!ours && now >= restart_at(claimant, peers_[holder])) {
    const Claimant risen = claimant;
    erase(index);
    return risen;
  }
  const bool still = now - claimant.last_heard < kLongDispute;
  if (claimant.reported || !still || now - claimant.since <= kLongDispute) return {};
  claimant.reported = true;
  PresenceEvent& event = events_.report(PresenceEventKind::disputed, claimant.announced);
  event.other = claimant.source;
  if (!ours) event.source = peers_[holder].source;
  return {};
}

std::optional<Claimant> Claims::take_free(PeerId own, nanoseconds now) {
  const Claimant* best = nullptr;
  const auto rank = [](const Claimant& c) {
    return std::tuple(!announces_established(c.announced), c.announced.started, c.epoch());
  };
  for (const Claimant& claimant : claimants_) {
    // A claimant that was silent since its claim waits for its next announcement.
    const bool silent = now - claimant.last_heard > config_.quiet;
    if (silent || claimant.id() == own || peers_.contains(claimant.id())) continue;
    if (best == nullptr || rank(claimant) < rank(*best)) best = &claimant;
  }
  if (best == nullptr) return {};
  const Claimant risen = *best;
  forget(risen.epoch());
  return risen;
}

nanoseconds Claims::next_step(PeerId own, nanoseconds looked) const noexcept {
  nanoseconds next = nanoseconds::max();
  for (const Claimant& claimant : claimants_) {
    next = std::min(next, claimant.last_heard + config_.patience() + nanoseconds(1));
    const std::size_t holder = peers_.find(claimant.id());
    if (claimant.id() != own && holder < peers_.size()) {
      next = std::min(next, restart_at(claimant, peers_[holder]));
    }
    // Skipped if the claimant had been silent for longer at the last check: then we were suspended
    // ourselves.
    const nanoseconds reported = claimant.since + kLongDispute + nanoseconds(1);
    if (!claimant.reported && std::max(reported, looked) < claimant.last_heard + kLongDispute) {
      next = std::min(next, reported);
    }
  }
  return next;
}

}  // namespace reckon::aoim
