// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// When each datagram of a replay is due: one line from recorded time to steady time for all of
// them, so that nothing adds up.
#pragma once

#include <chrono>
#include <cstdint>

namespace reckon::tools {

/// Maps recorded times to times of sending. Laps follow each other at the capture's mean spacing.
class ReplaySchedule {
 public:
  /// `rate` 2 plays twice as fast; 0 as fast as it goes. `start` steady.
  ReplaySchedule(double rate, std::chrono::nanoseconds start) : rate_(rate), start_(start) {}

  /// When a datagram recorded at `time` is due, steady; the first one of all is due at start.
  [[nodiscard]] std::chrono::nanoseconds due(std::chrono::nanoseconds time);
  /// The capture begins anew.
  void next_lap();
  /// Recorded time between the first datagram and the last that was asked for, over all laps.
  [[nodiscard]] std::chrono::nanoseconds played() const { return played_; }

 private:
  double rate_;
  std::chrono::nanoseconds start_;
  std::chrono::nanoseconds lap_begin_{};  ///< recorded time played when this lap began
  std::chrono::nanoseconds first_{};      ///< time of the lap's first datagram
  std::chrono::nanoseconds latest_{};     ///< greatest time of the lap
  std::chrono::nanoseconds played_{};
  std::uint64_t count_ = 0;  ///< datagrams of the lap
};

}  // namespace reckon::tools
