// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Send times of the datagrams of a replay: one linear map from recorded time to steady time, so
// that errors do not accumulate. A pause, another rate or a jump begins a new map.
#pragma once

#include <chrono>
#include <cstdint>

namespace reckon::tools {

/// Maps recorded times to send times. Positions are recorded time since the first datagram, over
/// all laps. Laps follow each other at the capture's mean spacing. Steady times never decrease.
class ReplaySchedule {
 public:
  using nanoseconds = std::chrono::nanoseconds;

  /// @param rate 2 plays twice as fast; 0 as fast as possible  @param start steady
  ReplaySchedule(double rate, nanoseconds start) : rate_(rate), start_(start), anchor_(start) {}

  /// Sets the next datagram of the lap, recorded at `time`; the very first one is due at start.
  void next(nanoseconds time);
  /// Whether that datagram comes before the target of a jump, and is not to be sent.
  [[nodiscard]] bool is_skipped() const { return at_ < sought_; }
  /// Steady time at which that datagram is due. Not to be called while paused.
  [[nodiscard]] nanoseconds due() const;
  /// Records that the datagram was sent.
  void sent(nanoseconds now);
  /// Restarts the capture for the next lap.
  void next_lap(nanoseconds now);

  void pause(nanoseconds now);
  void resume(nanoseconds now);
  [[nodiscard]] bool is_paused() const { return paused_; }
  /// @param rate > 0
  void set_rate(double rate, nanoseconds now);
  [[nodiscard]] double rate() const { return rate_; }
  /// Jumps by `step` within the lap, at most back to its beginning. Returns true if the capture
  /// must be read from its beginning again. A place after the end of the lap means the beginning of
  /// the next lap.
  [[nodiscard]] bool seek(nanoseconds step, nanoseconds now);

  /// Position of the replay within the lap.
  [[nodiscard]] nanoseconds position(nanoseconds now) const { return place(now) - lap_begin_; }
  /// Recorded time played up to the last sent datagram, without jumps.
  [[nodiscard]] nanoseconds played() const { return played_; }
  /// Steady time for it, without pauses.
  [[nodiscard]] nanoseconds active() const { return active_; }
  [[nodiscard]] nanoseconds paused(nanoseconds now) const {
    return paused_total_ + (paused_ ? now - pause_begin_ : nanoseconds{0});
  }
  /// The requested rate, averaged over its changes; 0: as fast as possible.
  [[nodiscard]] double asked() const;
  /// The achieved rate; 0 before two datagrams were sent.
  [[nodiscard]] double kept() const;
  [[nodiscard]] bool is_changed() const { return changed_; }

 private:
  [[nodiscard]] nanoseconds place(nanoseconds now) const;
  void begin_line(nanoseconds place, nanoseconds now);

  double rate_;
  nanoseconds start_;
  // The present map: recorded place, and its send time.
  nanoseconds anchor_;
  nanoseconds anchor_place_{};
  double planned_ = 0;  ///< recorded time by the earlier maps [ns]
  bool changed_ = false;

  nanoseconds lap_begin_{};                  ///< recorded time played at the beginning of this lap
  nanoseconds first_{};                      ///< time of the lap's first datagram
  nanoseconds latest_{};                     ///< greatest time of the lap
  std::uint64_t count_ = 0;                  ///< datagrams of the lap
  nanoseconds at_{};                         ///< place of the next datagram
  nanoseconds sought_ = nanoseconds::min();  ///< no datagram before this place is sent
  nanoseconds reached_{};                    ///< greatest place sent
  nanoseconds leg_begin_{}, before_leg_{};   ///< since the last jump, and played before it
  nanoseconds played_{}, active_{};
  double planned_at_sent_ = 0;

  bool paused_ = false;
  nanoseconds pause_begin_{}, pause_place_{}, paused_total_{};
};

}  // namespace reckon::tools
