// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/captures/replay_schedule.hpp"

#include <algorithm>
#include <cmath>

namespace reckon::tools {
namespace {

using std::chrono::nanoseconds;

constexpr double kCentury = 3.2e18;  // [ns]

double count(nanoseconds time) { return static_cast<double>(time.count()); }

}  // namespace

void ReplaySchedule::next(nanoseconds time) {
  if (count_++ == 0) first_ = latest_ = time;
  latest_ = std::max(latest_, time);
  at_ = lap_begin_ + (time - first_);
}

nanoseconds ReplaySchedule::due() const {
  if (rate_ <= 0) return anchor_;
  // A damaged capture may place a datagram centuries away; it waits.
  const double wait = std::clamp(count(at_ - anchor_place_) / rate_, -kCentury, kCentury);
  return anchor_ + nanoseconds(std::llround(wait));
}

void ReplaySchedule::sent(nanoseconds now) {
  reached_ = std::max(reached_, at_);
  played_ = before_leg_ + (reached_ - leg_begin_);
  active_ = now - start_ - paused_total_;
  planned_at_sent_ = planned_ + count(now - anchor_) * rate_;
}

void ReplaySchedule::next_lap(nanoseconds now) {
  const nanoseconds length = latest_ - first_;
  const bool beyond = sought_ > lap_begin_ + length;
  // A lap of one datagram has no spacing: it is sent once a second.
  const auto gaps = static_cast<std::int64_t>(count_) - 1;
  lap_begin_ += length + (gaps > 0 ? length / gaps : nanoseconds(std::chrono::seconds(1)));
  count_ = 0;
  if (!beyond) return;
  sought_ = nanoseconds::min();
  leg_begin_ = reached_ = lap_begin_;
  begin_line(lap_begin_, now);
  if (paused_) pause_place_ = lap_begin_;
}

void ReplaySchedule::pause(nanoseconds now) {
  if (paused_) return;
  pause_place_ = place(now);
  planned_ += count(now - anchor_) * rate_;
  anchor_ = now;
  pause_begin_ = now;
  paused_ = true;
}

void ReplaySchedule::resume(nanoseconds now) {
  if (!paused_) return;
  paused_ = false;
  paused_total_ += now - pause_begin_;
  anchor_ = now;
  anchor_place_ = pause_place_;
}

void ReplaySchedule::set_rate(double rate, nanoseconds now) {
  if (!paused_) begin_line(place(now), now);
  rate_ = rate;
  changed_ = true;
}

bool ReplaySchedule::seek(nanoseconds step, nanoseconds now) {
  const nanoseconds here = place(now);
  const nanoseconds there = std::max(lap_begin_, here + step);
  const bool again = there < reached_;
  before_leg_ += here - leg_begin_;
  sought_ = there == lap_begin_ ? nanoseconds::min() : there;
  leg_begin_ = reached_ = there;
  if (paused_)
    pause_place_ = there;
  else
    begin_line(there, now);
  if (again) count_ = 0;
  return again;
}

double ReplaySchedule::asked() const {
  if (!changed_) return rate_;
  return active_.count() > 0 ? planned_at_sent_ / count(active_) : rate_;
}

double ReplaySchedule::kept() const {
  return active_.count() > 0 && played_.count() > 0 ? count(played_) / count(active_) : 0;
}

nanoseconds ReplaySchedule::place(nanoseconds now) const {
  if (paused_) return pause_place_;
  if (rate_ <= 0) return reached_;
  const nanoseconds by_clock =
      anchor_place_ + nanoseconds(std::llround(count(now - anchor_) * rate_));
  // If the machine cannot keep up, the clock is ahead of the sent datagrams.
  return std::min(by_clock, std::max(at_, anchor_place_));
}

void ReplaySchedule::begin_line(nanoseconds place, nanoseconds now) {
  planned_ += count(now - anchor_) * rate_;
  anchor_ = now;
  anchor_place_ = place;
}

}  // namespace reckon::tools
