// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The half of presence that says when we announce ourselves and when we list whom we hear.
#include <algorithm>

#include "reckon/aoim/presence/presence.hpp"

namespace reckon::aoim {

using std::chrono::nanoseconds;

// Somebody may not know us: at once, and again for a while, since announcements are lost.
void Presence::announce_soon(nanoseconds now) noexcept {
  if (!running_) return;
  brisk_until_ = std::max(brisk_until_, now + config_.brisk);
  gap_ = config_.brisk_gap;
  next_cause_ = Cause::news;
  const auto earliest = last_ ? std::max(now, *last_ + config_.minimum_gap) : now;
  next_ = std::min(next_, earliest);
}

// Others hear us and may believe another of us: no list tells when that is over.
void Presence::insist(nanoseconds now) noexcept {
  insist_until_ = now + config_.brisk;
  announce_soon(now);
}

// All whom we hear tell that they hear us, and nobody tells of one whom we do not hear.
bool Presence::is_acquainted() const noexcept {
  bool anybody = false;
  for (const Peer& peer : peers_) {
    if (!peer.joined) continue;
    if (!peer.hears.us || peer.hears.strangers) return false;
    anybody = true;
  }
  return anybody && claimants_.empty();
}

// Until our announcements are known to have been heard they are repeated, ever more rarely.
void Presence::schedule_next(nanoseconds now) noexcept {
  nanoseconds gap = config_.heartbeat;
  next_cause_ = Cause::heartbeat;
  if (now < insist_until_) {
    gap = config_.brisk_gap;
    next_cause_ = Cause::news;
  } else if (now < brisk_until_ && !is_acquainted()) {
    gap = gap_;
    gap_ = std::min(2 * gap_, config_.heartbeat / 2);
    next_cause_ = Cause::repetition;
  }
  next_ = now + gap;
}

std::optional<std::span<const std::uint32_t>> Presence::take_list(nanoseconds now,
                                                                  nanoseconds said) {
  if (!running_ || now < next_list_) return {};
  const nanoseconds silence = 3 * config_.heartbeat / 4;
  const nanoseconds next = yield_at_ ? now : next_;
  if (!last_ || *last_ != now) {
    const nanoseconds silent = std::max(said, last_.value_or(said)) + silence;
    if (now < silent) {
      next_list_ = next > now ? std::min(silent, next) : silent;
      return {};
    }
    next_list_ = next + silence;
  } else {
    next_list_ = now + silence;
  }
  list_.clear();
  for (std::size_t i = 0; i < peers_.size(); ++i) {
    if (now - peers_[i].last_heard <= config_.listed) list_.push_back(epochs_[i]);
  }
  return list_;
}

}  // namespace reckon::aoim
