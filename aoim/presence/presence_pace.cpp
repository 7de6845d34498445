// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The half of presence that says when we announce ourselves.
#include <algorithm>
#include <cmath>

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

void Presence::announce_by(nanoseconds time) noexcept {
  if (running_ && last_) next_ = std::min(next_, std::max(time, *last_ + config_.minimum_gap));
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

void Presence::set_stretch(double stretch) noexcept {
  const double steps = std::clamp(std::ceil(16.0 * std::log2(stretch) - 1e-9), 0.0, 255.0);
  const auto code = static_cast<unsigned>(steps);
  own_.flags =
      static_cast<std::uint16_t>((own_.flags & ~unsigned{pdu::kPresenceStretch}) | code << 8);
}

double Presence::stretch_of(std::uint32_t epoch) const noexcept {
  const std::size_t known = peers_.find_epoch(epoch);
  if (known == peers_.size()) return 1.0;
  return std::exp2((peers_[known].announced.flags >> 8) / 16.0);
}

}  // namespace reckon::aoim
