// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/presence/announcement_pace.hpp"

#include <algorithm>

namespace reckon::aoim {
namespace {

using std::chrono::nanoseconds;

// A change of our own address is announced for this time.
constexpr std::chrono::milliseconds kReportMove{300};

}  // namespace

void AnnouncementPace::start(nanoseconds now) noexcept {
  running_ = true;
  announce_soon(now);
}

void AnnouncementPace::announce_soon(nanoseconds now) noexcept {
  if (!running_) return;
  brisk_until_ = std::max(brisk_until_, now + config_.brisk);
  gap_ = config_.brisk_gap;
  next_cause_ = Cause::news;
  const auto earliest = last_ ? std::max(now, *last_ + config_.minimum_gap / 50) : now;
  next_ = std::min(next_, earliest);
}

void AnnouncementPace::insist(nanoseconds now) noexcept {
  insist_until_ = now + config_.brisk;
  announce_soon(now);
}

void AnnouncementPace::announce_by(nanoseconds time) noexcept {
  if (running_ && last_) next_ = std::min(next_, std::max(time, *last_ + config_.minimum_gap));
}

void AnnouncementPace::note_own_source(const SourceAddress& source, nanoseconds now) noexcept {
  if (source.port == 0 || source == own_source_) return;
  const bool is_first = own_source_.port == 0;
  own_source_ = source;
  if (is_first) return;
  insist_until_ = std::max(insist_until_, now + kReportMove);
  announce_soon(now);
}

// Repeats our announcements, with growing gaps, until all received peers list us.
bool AnnouncementPace::note_announced(nanoseconds now, bool acquainted) noexcept {
  const bool is_more = next_cause_ != Cause::heartbeat;
  last_ = now;
  nanoseconds gap = config_.heartbeat;
  next_cause_ = Cause::heartbeat;
  if (now < insist_until_) {
    gap = config_.brisk_gap;
    next_cause_ = Cause::news;
  } else if (now < brisk_until_ && !acquainted) {
    gap = gap_;
    gap_ = std::min(2 * gap_, config_.heartbeat / 2);
    next_cause_ = Cause::repetition;
  }
  next_ = now + gap;
  return is_more;
}

// Delays by less than 0.2 s, because a rival that is silent for 1.2 s wins no dispute.
void AnnouncementPace::align(nanoseconds slot_time) noexcept {
  constexpr std::chrono::milliseconds kEarly{20}, kLatest{850};
  const nanoseconds at = (slot_time + next_ - *last_) % kSlot;
  if (next_cause_ == Cause::heartbeat && at > kLatest) next_ += kSlot + kEarly - at;
}

void AnnouncementPace::end_repetition() noexcept {
  next_ = *last_ + config_.heartbeat;
  next_cause_ = Cause::heartbeat;
}

}  // namespace reckon::aoim
