// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The time within an exercise, as set by Start/Resume and Stop/Freeze.
#pragma once

#include <algorithm>
#include <chrono>

#include "reckon/pdu/management/start_resume.hpp"
#include "reckon/pdu/management/stop_freeze.hpp"
#include "reckon/pdu/timestamp.hpp"

namespace reckon::peer {

/// Simulation time by the orders of a simulation manager, IEEE 1278.1 Start/Resume and Stop/Freeze.
/// Before the first order it is the UTC of this peer. One thread.
class ExerciseClock {
 public:
  /// @param utc of this peer when the order was taken. The order takes effect at its real-world
  /// time, or at once if that has passed or is not stated.
  void take(const pdu::StartResume& order, std::chrono::nanoseconds utc) noexcept {
    const std::chrono::nanoseconds from = std::max(to_time(order.real_world_time), utc);
    const std::chrono::nanoseconds stated = to_time(order.simulation_time);
    now_ = {utc, at(utc), is_running(utc)};
    next_ = {from, stated > std::chrono::nanoseconds(0) ? stated : at(from), true};
  }
  void take(const pdu::StopFreeze& order, std::chrono::nanoseconds utc) noexcept {
    const std::chrono::nanoseconds from = std::max(to_time(order.real_world_time), utc);
    now_ = {utc, at(utc), is_running(utc)};
    const std::chrono::nanoseconds stands =
        now_.running ? later(now_.simulation, from - utc) : now_.simulation;
    next_ = {from, stands, false};
  }

  /// Simulation time since 1970 at `utc`, not before the time of the last order. Constant while
  /// frozen.
  [[nodiscard]] std::chrono::nanoseconds at(std::chrono::nanoseconds utc) const noexcept {
    const Span& span = span_at(utc);
    return span.running ? later(span.simulation, utc - span.utc) : span.simulation;
  }
  [[nodiscard]] bool is_running(std::chrono::nanoseconds utc) const noexcept {
    return span_at(utc).running;
  }

 private:
  // Limit of accepted hours since 1970, in both directions: 228 years. Larger values are errors or
  // attacks.
  static constexpr std::int32_t kMostHours = 2'000'000;
  static std::chrono::nanoseconds to_time(const pdu::ClockTime& time) {
    const auto hours = std::clamp(time.hour, -kMostHours, kMostHours);
    return std::chrono::hours(hours) + pdu::past_the_hour(time.time_past_hour);
  }
  // Simulation time stops at the latest time of the clock.
  static std::chrono::nanoseconds later(std::chrono::nanoseconds time,
                                        std::chrono::nanoseconds span) {
    const bool is_beyond =
        span > std::chrono::nanoseconds(0) && time > std::chrono::nanoseconds::max() - span;
    return is_beyond ? std::chrono::nanoseconds::max() : time + span;
  }

  // From an instant on, time runs or is frozen.
  struct Span {
    std::chrono::nanoseconds utc{0}, simulation{0};
    bool running = true;
  };
  [[nodiscard]] const Span& span_at(std::chrono::nanoseconds utc) const noexcept {
    return utc >= next_.utc ? next_ : now_;
  }

  Span now_, next_;
};

}  // namespace reckon::peer
