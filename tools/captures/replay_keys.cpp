// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/captures/replay_keys.hpp"

#include <algorithm>

namespace reckon::tools {
namespace {

constexpr char kEscape = '\x1b';

void change_rate(ReplaySchedule& schedule, double factor, std::chrono::nanoseconds now) {
  if (schedule.rate() <= 0) return;  // the rate is already unlimited
  const double rate = std::clamp(schedule.rate() * factor, ReplayKeys::kSlowest,
                                 std::max(ReplayKeys::kFastest, schedule.rate()));
  if (rate != schedule.rate()) schedule.set_rate(rate, now);
}

ReplayKeys::Demand leap(ReplaySchedule& schedule, std::chrono::seconds step,
                        std::chrono::nanoseconds now) {
  return schedule.seek(step, now) ? ReplayKeys::Demand::read_again : ReplayKeys::Demand::nothing;
}

}  // namespace

ReplayKeys::Demand ReplayKeys::press(char key, ReplaySchedule& schedule,
                                     std::chrono::nanoseconds now) {
  if (key == kEscape) {
    state_ = State::escape;
    return Demand::nothing;
  }
  if (state_ == State::escape && (key == '[' || key == 'O')) {
    state_ = State::sequence;
    return Demand::nothing;
  }
  if (state_ == State::sequence) {
    // Numbers before the letter state which modifier keys were held.
    if ((key >= '0' && key <= '9') || key == ';') return Demand::nothing;
    state_ = State::plain;
    if (key == 'C') return leap(schedule, kLeap, now);
    if (key == 'D') return leap(schedule, -kLeap, now);
    return Demand::nothing;
  }
  state_ = State::plain;
  return plain_key(key, schedule, now);
}

ReplayKeys::Demand ReplayKeys::plain_key(char key, ReplaySchedule& schedule,
                                         std::chrono::nanoseconds now) {
  if (key == 'q') return Demand::end;
  if (key == ' ' && schedule.is_paused())
    schedule.resume(now);
  else if (key == ' ')
    schedule.pause(now);
  else if (key == '+' || key == '=')  // the same key without shift
    change_rate(schedule, 2, now);
  else if (key == '-')
    change_rate(schedule, 0.5, now);
  return Demand::nothing;
}

}  // namespace reckon::tools
