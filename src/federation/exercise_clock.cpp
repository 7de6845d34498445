// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/federation/exercise_clock.hpp"

#include <algorithm>

#include "reckon/pdu/timestamp.hpp"

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

// Limit of accepted hours since 1970, in both directions: 228 years. Larger values are errors or
// attacks.
constexpr std::int32_t kMostHours = 2'000'000;

nanoseconds to_time(const pdu::ClockTime& time) {
  const auto hours = std::clamp(time.hour, -kMostHours, kMostHours);
  return std::chrono::hours(hours) + pdu::past_the_hour(time.time_past_hour);
}

// Simulation time stops at the latest time of the clock.
nanoseconds later(nanoseconds time, nanoseconds span) {
  const bool is_beyond = span > nanoseconds(0) && time > nanoseconds::max() - span;
  return is_beyond ? nanoseconds::max() : time + span;
}

}  // namespace

void ExerciseClock::take(const pdu::StartResume& order, nanoseconds utc) noexcept {
  const nanoseconds from = std::max(to_time(order.real_world_time), utc);
  const nanoseconds stated = to_time(order.simulation_time);
  now_ = {utc, at(utc), is_running(utc)};
  next_ = {from, stated > nanoseconds(0) ? stated : at(from), true};
}

void ExerciseClock::take(const pdu::StopFreeze& order, nanoseconds utc) noexcept {
  const nanoseconds from = std::max(to_time(order.real_world_time), utc);
  now_ = {utc, at(utc), is_running(utc)};
  const nanoseconds stands = now_.running ? later(now_.simulation, from - utc) : now_.simulation;
  next_ = {from, stands, false};
}

nanoseconds ExerciseClock::at(nanoseconds utc) const noexcept {
  const Span& span = span_at(utc);
  return span.running ? later(span.simulation, utc - span.utc) : span.simulation;
}

}  // namespace reckon::peer
