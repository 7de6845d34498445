// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The half of presence that settles who holds which id.
#include <algorithm>
#include <tuple>

#include "reckon/aoim/presence/presence.hpp"
#include "reckon/pdu/random/split_mix.hpp"

namespace reckon::aoim {
namespace {

using std::chrono::nanoseconds;

// What a life that is over said last may arrive so late.
constexpr std::chrono::milliseconds kStraggler{200};
// A life that was taken for over and speaks after this is alive.
constexpr std::chrono::milliseconds kRevival{1000};
// A claim that is not settled after this is reported.
constexpr std::chrono::milliseconds kLongDispute{1000};
// Beyond the wait of a restart and a straggler: all who hear us believe us.
constexpr std::chrono::milliseconds kBelieved{850};
// A rival's claim counts for so long, which is an announcement, so that none that has fallen silent
// wins; and a witness's list: at 20 % loss all four that it sends meanwhile are lost once in 600
// times.
constexpr std::chrono::milliseconds kRecent{1200}, kRecentList{4000};
// How often witnesses are counted in a dispute.
constexpr std::chrono::milliseconds kVerdictGap{250};
// Who has lost so many ids in a row, none held for so long, keeps the next. If witnesses take that
// too, the dispute about the one after it lasts longer: somebody follows it.
constexpr int kMostYields = 3;
constexpr std::chrono::seconds kInPeace{10};
// How long the holder of an id has to be silent until a life on another host has it.
constexpr std::chrono::milliseconds kElsewhere{4500};
// Ids to draw from, for each peer known: losers of one race seldom meet again.
constexpr std::size_t kSpread = 8;

// Of two that claim an id anew: a total order that both compute alike and that no restart turns
// round. Who started first keeps it; of two in the same second, the lower epoch.
bool precedes(const pdu::Presence& one, const pdu::Presence& other) noexcept {
  return std::tie(one.started, one.epoch) < std::tie(other.started, other.epoch);
}

bool says_established(const pdu::Presence& heard) noexcept {
  return (heard.flags & pdu::kPresenceEstablished) != 0;
}

}  // namespace

// Also who has given way often: somebody follows it from id to id.
bool Presence::is_established(nanoseconds now) const noexcept {
  return running_ && (now - claimed_ >= config_.established || yields_ >= kMostYields);
}

bool Presence::is_taken(PeerId id) const noexcept {
  return id == own_.simulation || peers_.find(id) < peers_.size();
}

Presence::Claimant* Presence::find_claimant(std::uint32_t epoch) noexcept {
  const auto found = std::find_if(claimants_.begin(), claimants_.end(), [epoch](const Claimant& c) {
    return c.announced.epoch == epoch;
  });
  return found == claimants_.end() ? nullptr : &*found;
}

void Presence::forget_claimant(std::uint32_t epoch) noexcept {
  std::erase_if(claimants_, [epoch](const Claimant& c) { return c.announced.epoch == epoch; });
}

// Whether this life is over. Who speaks long after it was believed so is alive, or under another
// id, from the same source.
bool Presence::is_over(const pdu::Presence& heard, nanoseconds now, const SourceAddress& from) {
  FormerLife* life = former_.find(heard.epoch);
  if (life == nullptr) return false;
  if (life->tip.is_chained()) {
    if (judge(life->tip, heard, now, false) != Opening::newer) return true;
    life->tip = LifeTip(heard, now);  // remembered as one that came back
    return false;
  }
  const bool from_elsewhere =
      life->source.port != 0 && life->source != from && now - life->since <= config_.pin;
  const bool is_straggler = heard.simulation == life->id && now - life->since <= kRevival;
  if (from_elsewhere || is_straggler) return true;
  former_.take(heard.epoch);
  return false;
}

// A peer that is not in the table announces itself.
void Presence::claim(const pdu::Presence& heard, nanoseconds now, const SourceAddress& from) {
  Claimant* claimant = find_claimant(heard.epoch);
  if (claimant != nullptr && claimant->source.port != 0 && claimant->source != from) {
    ++counts_.impostors;
    return;
  }
  if (!is_taken(heard.simulation)) {
    forget_claimant(heard.epoch);
    return welcome(heard, now, from);
  }
  if (claimant == nullptr) {
    if (is_crowd(from)) return;
    if (claimants_.size() == config_.claims) {
      ++counts_.table_full;
      return;
    }
    claimants_.push_back({heard, now, now, from, {}, {}});
    claimant = &claimants_.back();
    insist(now);
  } else if (claimant->announced.simulation != heard.simulation) {
    claimant->since = now;
    claimant->reported = false;
  }
  claimant->announced = heard;
  claimant->last_heard = now;
  claimant->source = from;
  claimant->tip = LifeTip(heard, now);
  if (heard.simulation == own_.simulation) settle_with(*claimant, now);
}

void Presence::settle_with(const Claimant& rival, nanoseconds now) {
  ++counts_.conflicts;
  const bool mine = is_established(now), theirs = says_established(rival.announced);
  if (mine && theirs) return;  // witnesses are asked later
  if (mine || (!theirs && precedes(own_, rival.announced))) return insist(now);
  if (!yield_at_) yield_at_ = now + config_.listen;
  yields_for_good_ = yields_for_good_ || theirs;
}

// When the claimant is believed a restart if the holder says nothing more.
nanoseconds Presence::restart_at(const Claimant& claimant, const Peer& holder) const noexcept {
  if (claimant.last_heard < holder.last_heard) return nanoseconds::max();  // its turn to speak
  // A process that starts anew does so on its host; one elsewhere waits for longer.
  const bool is_elsewhere = holder.tip.is_chained() && claimant.source.port != 0 &&
                            holder.source.port != 0 &&
                            claimant.source.octets != holder.source.octets;
  if (is_elsewhere) return std::max(claimant.since, holder.last_heard + kElsewhere);
  const bool lives = holder.last_heard > claimant.since + kStraggler;
  // Nor is one that has held its id for long a new life: two halves of a network have met.
  if (says_established(claimant.announced)) {
    return std::max(claimant.since + config_.restart_wait, holder.last_heard + config_.quiet);
  }
  if (lives) return holder.last_heard + config_.quiet;
  const bool race = claimant.since - holder.first_heard < config_.established;
  return std::max(claimant.since, holder.last_heard) +
         (race ? config_.race_wait : config_.restart_wait);
}

bool Presence::settle_claims(nanoseconds now) {
  bool risen_any = false;
  for (std::size_t i = claimants_.size(); i-- > 0;) {
    Claimant& claimant = claimants_[i];
    if (now - claimant.last_heard > config_.patience()) {
      claimants_.erase(claimants_.begin() + static_cast<std::ptrdiff_t>(i));
      continue;
    }
    const bool ours = claimant.announced.simulation == own_.simulation;
    const std::size_t holder = peers_.find(claimant.announced.simulation);
    if (!ours && holder == peers_.size()) continue;  // free: see below
    if (!ours && now >= restart_at(claimant, peers_[holder])) {
      const Claimant risen = claimant;
      claimants_.erase(claimants_.begin() + static_cast<std::ptrdiff_t>(i));
      begin_life(holder, risen, now);
      risen_any = true;
      continue;
    }
    const bool still = now - claimant.last_heard < kLongDispute;
    if (claimant.reported || !still || now - claimant.since <= kLongDispute) continue;
    claimant.reported = true;
    PresenceEvent& event = events_.report(PresenceEventKind::disputed, claimant.announced);
    event.other = claimant.source;
    if (!ours) event.source = peers_[holder].source;
  }
  return fill_free_ids(now) || risen_any;
}

// An id that its holder gave up goes to the best of those that claim it.
bool Presence::fill_free_ids(nanoseconds now) {
  for (bool any = false;; any = true) {
    const Claimant* best = nullptr;
    const auto rank = [](const Claimant& c) {
      return std::tuple(!says_established(c.announced), c.announced.started, c.announced.epoch);
    };
    for (const Claimant& claimant : claimants_) {
      // Who has been silent since its claim waits for its next word.
      const bool silent = now - claimant.last_heard > config_.quiet;
      if (silent || is_taken(claimant.announced.simulation)) continue;
      if (best == nullptr || rank(claimant) < rank(*best)) best = &claimant;
    }
    if (best == nullptr) return any;
    const Claimant risen = *best;
    forget_claimant(risen.announced.epoch);
    welcome(risen.announced, now, risen.source);
    const std::size_t place = peers_.find_epoch(risen.announced.epoch);
    if (place == peers_.size()) continue;  // no room
    // It may have been silent since its claim.
    peers_[place].hears = risen.hears;
    peers_[place].tip = risen.tip;
    peers_[place].last_heard = risen.last_heard;
    watch(peers_[place]);
  }
}

void Presence::look_at_own_id(nanoseconds now) {
  if (!running_) {
    if (yield_at_ && now >= *yield_at_) take_next_id(now);
    return;
  }
  if (now >= next_verdict_) {
    next_verdict_ = now + kVerdictGap;
    const bool loses =
        std::any_of(claimants_.begin(), claimants_.end(), [&](const Claimant& claimant) {
          return claimant.announced.simulation == id() && loses_by_witnesses(claimant, now);
        });
    if (loses && is_established(now) && !yield_at_) {
      yield_at_ = now;
      yields_for_good_ = true;
    }
  }
  if (yield_at_ && now >= *yield_at_) {
    // A newcomer came just before we had held it for long.
    if (is_established(now) && !yields_for_good_) {
      yield_at_.reset();
      insist(now);
    } else {
      take_next_id(now);
    }
  }
  if (!settled_told_ && !yield_at_ && now - claimed_ >= kBelieved) {
    settled_told_ = true;
    events_.report(PresenceEventKind::settled, own_);
  }
}

// After a partition both have held the id for long. Whom more of the others hear keeps it; words of
// its own, such as when it started, count only where these are equal, so that one that forges them
// evicts nobody whom others hear.
bool Presence::loses_by_witnesses(const Claimant& rival, nanoseconds now) const noexcept {
  const nanoseconds lasts = now - rival.since;
  const nanoseconds all_told = config_.dispute + config_.list_round(peers_.size());
  const nanoseconds least = yields_ > kMostYields    ? 2 * all_told
                            : yields_ == kMostYields ? all_told
                                                     : all_told / 2;
  if (!says_established(rival.announced) || lasts < least) return false;
  if (now - rival.last_heard > kRecent) return false;
  // Who was cut off from us, maybe with the rival, has to hear us before it tells whom it hears.
  const bool any_is_back = std::ranges::any_of(peers_, [&](const Peer& peer) {
    return peer.tip.is_chained() && now - peer.back_since < config_.dispute / 2;
  });
  if (any_is_back) return false;
  const std::uint32_t theirs = rival.announced.epoch;
  const nanoseconds since = now - kRecentList - config_.list_round(peers_.size());
  const auto names_us = [since](const Hearing& hears) { return hears.us_at > since && hears.us; };
  const auto names_rival = [since, theirs](const Hearing& hears) {
    return hears.rival_at > since && hears.rival == theirs;
  };
  const Support mine =
      support([&](const Hearing& hears, std::uint32_t) { return names_us(hears); });
  const Support other = support([&](const Hearing& hears, std::uint32_t witness) {
    return names_rival(hears) && witness != theirs;
  });
  // Whether somebody whom we hear has named neither of us and will: a newcomer, or one that was
  // cut off. One that never tells whom it hears is no witness.
  const bool awaited = std::any_of(peers_.begin(), peers_.end(), [&](const Peer& peer) {
    const bool tells = peer.hears.came > since || now - peer.first_heard <= config_.established;
    return peer.joined && peer.confirmed && tells && now - peer.last_heard <= config_.listed &&
           !names_us(peer.hears) && !names_rival(peer.hears);
  });
  if (lasts < all_told) return !awaited && mine < other;
  return mine != other ? mine < other : !awaited && precedes(rival.announced, own_);
}

template <typename Names>
Presence::Support Presence::support(const Names& names) const noexcept {
  Support sum;
  const std::size_t count = peers_.size() + claimants_.size();
  const auto source_of_witness = [&](std::size_t i) -> const SourceAddress* {
    if (i < peers_.size())
      return names(peers_[i].hears, peers_.epoch(i)) ? &peers_[i].source : nullptr;
    const Claimant& claimant = claimants_[i - peers_.size()];
    return names(claimant.hears, claimant.announced.epoch) ? &claimant.source : nullptr;
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

void Presence::take_next_id(nanoseconds now) {
  const PeerId former = own_.simulation;
  own_.simulation = draw_id();
  yield_at_.reset();
  yields_for_good_ = false;
  yields_ = now - claimed_ < kInPeace ? yields_ + 1 : 1;
  claimed_ = now;
  settled_told_ = false;
  last_.reset();  // nobody has heard this id: no gap to keep
  events_.report(PresenceEventKind::identity_changed, own_).former = former;
  insist(now);
  fill_free_ids(now);
}

// A hash of our epoch, so that the losers of one race draw different ones, among those not heard.
PeerId Presence::draw_id() noexcept {
  const std::size_t known = peers_.size() + claimants_.size() + 1;
  const std::size_t range = std::min<std::size_t>(kSpread * known, 0xFFFE);
  PeerId id = own_.simulation;
  const auto is_heard = [&] {
    return is_taken(id) || std::any_of(claimants_.begin(), claimants_.end(),
                                       [&](const auto& c) { return c.announced.simulation == id; });
  };
  do {
    const std::uint64_t drawn = pdu::split_mix(std::uint64_t{own_.epoch} << 32 | draws_++);
    id.application = static_cast<std::uint16_t>(1 + drawn % range);
  } while (is_heard());
  return id;
}

void Presence::take_scene_peer() noexcept {
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

nanoseconds Presence::next_identity_step() const noexcept {
  nanoseconds next = nanoseconds::max();
  if (yield_at_) next = *yield_at_;
  if (running_ && !settled_told_ && !yield_at_) next = std::min(next, claimed_ + kBelieved);
  for (const Claimant& claimant : claimants_) {
    next = std::min(next, claimant.last_heard + config_.patience() + nanoseconds(1));
    const std::size_t holder = peers_.find(claimant.announced.simulation);
    if (claimant.announced.simulation == own_.simulation) {
      next = std::min(next, std::max(next_verdict_, claimant.since + config_.dispute / 2));
    } else if (holder < peers_.size()) {
      next = std::min(next, restart_at(claimant, peers_[holder]));
    }
    // Not where it was silent for longer when we looked last, having stood still ourselves.
    const nanoseconds reported = claimant.since + kLongDispute + nanoseconds(1);
    const nanoseconds looked = awake_.value_or(nanoseconds::min());
    if (!claimant.reported && std::max(reported, looked) < claimant.last_heard + kLongDispute) {
      next = std::min(next, reported);
    }
  }
  return next;
}

}  // namespace reckon::aoim
