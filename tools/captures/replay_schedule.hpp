// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// When each datagram of a replay is due: one line from recorded time to steady time, so that
// nothing adds up. A pause, another rate or a leap begins a new line.
#pragma once

#include <chrono>
#include <cstdint>

namespace reckon::tools {

/// Maps recorded times to times of sending. Positions are recorded time since the first datagram,
/// over all laps; laps follow each other at the capture's mean spacing. Steady times never fall.
class ReplaySchedule {
 public:
  using nanoseconds = std::chrono::nanoseconds;

  /// `rate` 2 plays twice as fast; 0 as fast as it goes. `start` steady.
  ReplaySchedule(double rate, nanoseconds start) : rate_(rate), start_(start), anchor_(start) {}

  /// The next datagram of the lap, recorded at `time`; the first one of all is due at start.
  void next(nanoseconds time);
  /// Whether that datagram lies before the place that was sought, and is not to be sent.
  [[nodiscard]] bool is_skipped() const { return at_ < sought_; }
  /// When that datagram is due, steady. Not asked for while paused.
  [[nodiscard]] nanoseconds due() const;
  /// That datagram was sent.
  void sent(nanoseconds now);
  /// The capture begins anew.
  void next_lap(nanoseconds now);

  void pause(nanoseconds now);
  void resume(nanoseconds now);
  [[nodiscard]] bool is_paused() const { return paused_; }
  /// Above 0.
  void set_rate(double rate, nanoseconds now);
  [[nodiscard]] double rate() const { return rate_; }
  /// Leaps by `step` within the lap, back to its beginning at most. True where the capture must be
  /// read from its beginning again; a place behind its end is the beginning of the next lap.
  [[nodiscard]] bool seek(nanoseconds step, nanoseconds now);

  /// Where the replay is within the lap.
  [[nodiscard]] nanoseconds position(nanoseconds now) const { return place(now) - lap_begin_; }
  /// Recorded time that was played up to the last datagram sent: leaps do not count.
  [[nodiscard]] nanoseconds played() const { return played_; }
  /// Steady time that this took: pauses do not count.
  [[nodiscard]] nanoseconds active() const { return active_; }
  [[nodiscard]] nanoseconds paused(nanoseconds now) const {
    return paused_total_ + (paused_ ? now - pause_begin_ : nanoseconds{0});
  }
  /// The rate that was asked for, on average where it was changed; 0: as fast as it goes.
  [[nodiscard]] double asked() const;
  /// The rate that was kept; 0 before two datagrams were sent.
  [[nodiscard]] double kept() const;
  [[nodiscard]] bool is_changed() const { return changed_; }

 private:
  [[nodiscard]] nanoseconds place(nanoseconds now) const;
  void begin_line(nanoseconds place, nanoseconds now);

  double rate_;
  nanoseconds start_;
  // The line: recorded place, and when it is due.
  nanoseconds anchor_;
  nanoseconds anchor_place_{};
  double planned_ = 0;  ///< recorded time by the lines before this one [ns]
  bool changed_ = false;

  nanoseconds lap_begin_{};                  ///< recorded time played when this lap began
  nanoseconds first_{};                      ///< time of the lap's first datagram
  nanoseconds latest_{};                     ///< greatest time of the lap
  std::uint64_t count_ = 0;                  ///< datagrams of the lap
  nanoseconds at_{};                         ///< place of the datagram that is next
  nanoseconds sought_ = nanoseconds::min();  ///< nothing before this place is sent
  nanoseconds reached_{};                    ///< greatest place that was sent
  nanoseconds leg_begin_{}, before_leg_{};   ///< since the last leap, and played before that
  nanoseconds played_{}, active_{};
  double planned_at_sent_ = 0;

  bool paused_ = false;
  nanoseconds pause_begin_{}, pause_place_{}, paused_total_{};
};

}  // namespace reckon::tools
