// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The time within an exercise, as Start/Resume and Stop/Freeze set it.
#pragma once

#include <chrono>

#include "reckon/pdu/management/start_resume.hpp"
#include "reckon/pdu/management/stop_freeze.hpp"

namespace reckon::peer {

/// Simulation time by the orders of a simulation manager, IEEE 1278.1 Start/Resume and Stop/Freeze.
/// It is the UTC of this peer until the first order comes. One thread.
class ExerciseClock {
 public:
  /// @param utc of this peer at which the order was taken: it takes effect at its real-world time,
  /// at once where that is over or not stated.
  void take(const pdu::StartResume& order, std::chrono::nanoseconds utc) noexcept;
  void take(const pdu::StopFreeze& order, std::chrono::nanoseconds utc) noexcept;

  /// Simulation time since 1970 at `utc`, not before that of the last order. Stands still while
  /// frozen.
  [[nodiscard]] std::chrono::nanoseconds at(std::chrono::nanoseconds utc) const noexcept;
  [[nodiscard]] bool is_running(std::chrono::nanoseconds utc) const noexcept {
    return span_at(utc).running;
  }

 private:
  // From an instant on, time runs or stands.
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
