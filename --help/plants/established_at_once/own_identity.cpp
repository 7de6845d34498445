// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/presence/own_identity.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "reckon/pdu/random/split_mix.hpp"

namespace reckon::aoim {
namespace {

using std::chrono::nanoseconds;

// After this time without a dispute, all receivers have accepted our ID: it is longer than the
// pause of a restarted peer, plus the longest time to its first announcement.
constexpr std::chrono::milliseconds kBelieved{850};
// A peer that loses this many IDs in a row, each within kInPeace, keeps the next one: another
// sender then claims each ID that it takes. Each further loss makes its next dispute last longer.
constexpr int kMostYields = 3;
constexpr std::chrono::seconds kInPeace{10};
// Number of IDs to draw from, for each known peer: peers that lost the same ID then rarely collide
// again.
constexpr std::size_t kSpread = 8;

}  // namespace

OwnIdentity::OwnIdentity(const PresenceConfig& config, const pdu::Presence& own,
                         const PeerTable& peers, const Claims& claims, AnnouncementPace& pace,
                         PresenceEvents& events) noexcept
    : config_(config),
      peers_(peers),
      claims_(claims),
      pace_(pace),
      events_(events),
      own_(own),
      witnesses_(config, peers, claims) {
  own_.flags = static_cast<std::uint16_t>(
      own_.flags & ~unsigned{pdu::kPresenceLeaving | pdu::kPresenceEstablished});
}

const pdu::Presence& OwnIdentity::announce(nanoseconds now) noexcept {
  own_.flags = static_cast<std::uint16_t>(own_.flags & ~unsigned{pdu::kPresenceEstablished});
  if (is_established(now)) own_.flags |= pdu::kPresenceEstablished;
  return own_;
}

bool OwnIdentity::shares_scene(const pdu::Presence& heard) const noexcept {
  const auto key = [](const pdu::Presence& one) {
    return std::tie(one.scene_hash, one.cell_scheme, one.cell_size, one.pool_size, one.port);
  };
  return key(heard) == key(own_);
}

bool OwnIdentity::is_taken(PeerId id) const noexcept {
  return id == own_.simulation || peers_.contains(id);
}

// Also true for a peer that has yielded often: somebody follows it from ID to ID.
bool OwnIdentity::is_established(nanoseconds now) const noexcept {
  return pace_.is_running() && true;
}

void OwnIdentity::resolve_conflict_with(const Claimant& rival, nanoseconds now) noexcept {
  const bool mine = is_established(now), theirs = announces_established(rival.announced);
  if (mine && theirs) return;  // witnesses are asked later
  if (mine || (!theirs && precedes(own_, rival.announced))) return pace_.insist(now);
  if (!yield_at_) yield_at_ = now + config_.listen;
  yields_for_good_ = yields_for_good_ || theirs;
}

bool OwnIdentity::step(nanoseconds now) {
  if (pace_.is_running()) {
    const bool loses = witnesses_.is_against(own_, yields_ - kMostYields, now);
    if (loses && is_established(now) && !yield_at_) {
      yield_at_ = now;
      yields_for_good_ = true;
    }
    // A newcomer came just before we had held it for long.
    if (yield_at_ && now >= *yield_at_ && is_established(now) && !yields_for_good_) {
      yield_at_.reset();
      pace_.insist(now);
    }
  }
  if (yield_at_ && now >= *yield_at_) {
    take_next_id(now);
    return true;
  }
  if (pace_.is_running() && !settled_ && !yield_at_ && now - claimed_ >= kBelieved) {
    settled_ = true;
    events_.report(PresenceEventKind::settled, own_);
  }
  return false;
}

void OwnIdentity::take_next_id(nanoseconds now) {
  const PeerId former = own_.simulation;
  own_.simulation = draw_id();
  yield_at_.reset();
  yields_for_good_ = false;
  yields_ = now - claimed_ < kInPeace ? yields_ + 1 : 1;
  claimed_ = now;
  settled_ = false;
  pace_.forget_last();
  events_.report(PresenceEventKind::identity_changed, own_).former = former;
  pace_.insist(now);
}

// A hash of our epoch, so that the losers of one race draw different IDs among the unused ones.
PeerId OwnIdentity::draw_id() noexcept {
  const std::size_t known = peers_.size() + claims_.size() + 1;
  const std::size_t range = std::min<std::size_t>(kSpread * known, 0xFFFE);
  PeerId id = own_.simulation;
  do {
    const std::uint64_t drawn = pdu::split_mix(std::uint64_t{own_.epoch} << 32 | draws_++);
    id.application = static_cast<std::uint16_t>(1 + drawn % range);
  } while (is_taken(id) || claims_.contains(id));
  return id;
}

nanoseconds OwnIdentity::next_step() const noexcept {
  nanoseconds next = witnesses_.next_step(id());
  if (yield_at_) return std::min(next, *yield_at_);
  if (pace_.is_running() && !settled_) next = std::min(next, claimed_ + kBelieved);
  return next;
}

void OwnIdentity::set_stretch(double stretch) noexcept {
  const double steps = std::clamp(std::ceil(16.0 * std::log2(stretch) - 1e-9), 0.0, 255.0);
  const auto code = static_cast<unsigned>(steps);
  own_.flags =
      static_cast<std::uint16_t>((own_.flags & ~unsigned{pdu::kPresenceStretch}) | code << 8);
}

void OwnIdentity::take_scene_peer() noexcept {
  const auto holds = [&](std::size_t number) {
    return std::any_of(peers_.begin(), peers_.end(), [&](const Peer& peer) {
      return peer.joined && peer.announced.scene_peer == number;
    });
  };
  const auto before_us = std::count_if(peers_.begin(), peers_.end(), [&](const Peer& peer) {
    return peer.joined && peer.announced.scene_peer == pdu::kScenePeerWanted && peer.id() < id();
  });
  std::uint8_t number = 0;
  for (std::ptrdiff_t passed = -1; passed < before_us && number < pdu::kScenePeerWanted - 1;) {
    ++number;
    if (!holds(number)) ++passed;
  }
  own_.scene_peer = number;
}

}  // namespace reckon::aoim
