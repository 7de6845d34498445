// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The time within an exercise, as set by Start/Resume and Stop/Freeze.
#pragma once

#include <chrono>

#include "reckon/pdu/management/start_resume.hpp"
#include "reckon/pdu/management/stop_freeze.hpp"

namespace reckon::peer {

/// Simulation time by the orders of a simulation manager, IEEE 1278.1 Start/Resume and Stop/Freeze.
/// Before the first order it is the UTC of this peer. One thread.
class ExerciseClock {
 public:
  /// @param utc of this peer when the order was taken. The order takes effect at its real-world
  /// time, or at once if that has passed or is not stated.
  void take(const pdu::StartResume& order, std::chrono::nanoseconds utc) noexcept;
  void take(const pdu::StopFreeze& order, std::chrono::nanoseconds utc) noexcept;

  /// Simulation time since 1970 at `utc`, not before the time of the last order. Constant while
  /// frozen.
  [[nodiscard]] std::chrono::nanoseconds at(std::chrono::nanoseconds utc) const noexcept;
  [[nodiscard]] bool is_running(std::chrono::nanoseconds utc) const noexcept {
    return span_at(utc).running;
  }

 private:
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
