// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Converts a state's timestamp from its sender's clock to the time of our clock at which the state
// was true. Used between the decoded PDU and the state table.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "reckon/peer/clocks/leap_watch.hpp"
#include "reckon/peer/clocks/least_transit.hpp"

namespace reckon::peer {

/// Knowledge of the clocks besides the timestamps.
struct ClockEvidence {
  /// Whether our own UTC is UTC, so that an absolute timestamp may be trusted.
  bool aligned = true;
  /// Lead of the sender's UTC over ours, from an exchange with its peer; it has priority over
  /// trust.
  std::optional<std::chrono::nanoseconds> ahead;
};

/// Maps one sender's DIS timestamps to local steady time, without a jump even if the clocks jump.
///
/// The packet with the shortest transit relates the two clocks (LeastTransit). Its transit is known
/// from an exchange of times, or from two absolute clocks; else the last known value is used, at
/// first zero. The relation in use follows this estimate slowly (kTimeConstant). Times of newer
/// states never fall and are never in the future.
///
/// A state that is not newer than the last one, or that is off by more than a second, is refused.
/// If several such states agree (LeapWatch), the sender's clock has jumped, and its time continues
/// where it was. A state with the stamp of the last one is newer by the difference of their
/// arrivals: its sender's clock has stopped, or ticks slowly. The caller has to filter out copies
/// of a state. No allocation; one thread.
class SenderClock {
 public:
  /// Longest transit of the fastest packet of two absolute clocks; if it is longer, one of them is
  /// wrong, and they are treated as relative.
  static constexpr std::chrono::nanoseconds kMostTransit = std::chrono::milliseconds(300);
  /// Largest time by which a packet may appear to arrive before it was sent.
  static constexpr std::chrono::nanoseconds kMostAhead = std::chrono::milliseconds(128);
  /// The same as kMostTransit if an exchange has measured it.
  static constexpr std::chrono::nanoseconds kMostMeasuredTransit = std::chrono::seconds(2);
  /// A sender known for less than this time is mapped by the newest estimate at once.
  static constexpr std::chrono::nanoseconds kYoung = std::chrono::seconds(2);
  /// After that, a change is followed by a low-pass filter with this time constant, at a rate of at
  /// least 1 and at most 100 ms/s. A change of 8 ms moves the shown pose of a vehicle at 20 m/s by
  /// 1 mm a frame of 60 Hz, the largest change by a tenth of its speed.
  static constexpr std::chrono::nanoseconds kTimeConstant = std::chrono::seconds(4);

  /// A clock that was once found to run ahead is followed immediately to a further lead for this
  /// time. This occurs in a replay at another speed with pauses.
  static constexpr std::chrono::nanoseconds kRunsAhead = std::chrono::seconds(60);

  /// Local steady time of the stamped instant, never after `now`; nullopt if it is refused as
  /// stale. `now`, `utc_now`: the same instant on our steady clock and in UTC [ns]. Cost: some 40
  /// ns.
  [[nodiscard]] std::optional<std::chrono::nanoseconds> local_time(
      std::uint32_t timestamp, std::chrono::nanoseconds now, std::chrono::nanoseconds utc_now,
      const ClockEvidence& evidence = {}) noexcept;

  /// Whether the last accepted state has shown that the sender's clock has jumped.
  [[nodiscard]] bool has_leapt() const noexcept { return leapt_; }
  /// Rate at which the sender's clock falls behind ours [s/s].
  [[nodiscard]] double drift() const noexcept { return transit_.drift(); }

 private:
  using Nanoseconds = std::chrono::nanoseconds;

  [[nodiscard]] Nanoseconds by_arrival(Nanoseconds now) noexcept;
  [[nodiscard]] Nanoseconds unwrapped(std::uint32_t timestamp, Nanoseconds now) const noexcept;
  [[nodiscard]] bool is_odd(Nanoseconds sent, Nanoseconds now) const noexcept;
  void learn_transit(std::uint32_t timestamp, Nanoseconds difference, Nanoseconds least,
                     Nanoseconds utc_now, const ClockEvidence& evidence) noexcept;
  void follow(Nanoseconds estimate, Nanoseconds now) noexcept;

  bool started_ = false;
  bool leapt_ = false;
  std::uint32_t last_timestamp_ = 0;  // of the newest state
  Nanoseconds last_sent_{0};          // the same, unwrapped and without jumps
  Nanoseconds last_heard_{0};         // and its arrival
  Nanoseconds last_taken_{0};         // or the last one with the same timestamp
  Nanoseconds last_mapped_{0};        // and its mapped time
  Nanoseconds first_heard_{0};
  LeastTransit transit_;  // of (arrival - unwrapped time)
  LeapWatch watch_;
  Nanoseconds runs_ahead_until_{0};  // until then another lead is expected
  Nanoseconds base_{0};              // transit of the fastest packet, as far as known
  Nanoseconds offset_{0};            // local time - unwrapped time, in use
};

}  // namespace reckon::peer
