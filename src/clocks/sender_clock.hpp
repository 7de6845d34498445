// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// When, on our clock, was the state true that a sender stamped on its own? Sits between the decoded
// PDU and the state table.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "reckon/peer/clocks/leap_watch.hpp"
#include "reckon/peer/clocks/least_transit.hpp"

namespace reckon::peer {

/// What is known of the clocks besides the timestamps.
struct ClockEvidence {
  /// Our own UTC is UTC, so that an absolute timestamp may be taken at its word.
  bool aligned = true;
  /// How far the sender's UTC is ahead of ours, from an exchange with its peer; it counts before
  /// the word.
  std::optional<std::chrono::nanoseconds> ahead;
};

/// Maps one sender's DIS timestamps to local steady time, without a jump whatever clocks do.
///
/// The packet on the fastest way ties the two clocks together (LeastTransit); its transit is known
/// from an exchange of times, or by the word of two absolute clocks, else the last value known, at
/// first zero. The tie follows its estimate slowly (kTimeConstant), times given to newer states
/// never fall and never lie in the future.
///
/// A state that is not newer than the last one, or that is off by more than a second, is refused,
/// unless several agree (LeapWatch): then the sender's clock has leapt, and its time goes on where
/// it was. One with the same stamp as the last is as much newer as it came later: its sender's
/// clock stands, or ticks slowly. Copies of a state are for the caller to keep away. No allocation;
/// one thread.
class SenderClock {
 public:
  /// The fastest packet of two absolute clocks takes no longer than this, else one of them is
  /// wrong: they are treated as relative.
  static constexpr std::chrono::nanoseconds kMostTransit = std::chrono::milliseconds(300);
  /// And it arrives at most so long before it was sent.
  static constexpr std::chrono::nanoseconds kMostAhead = std::chrono::milliseconds(128);
  /// The same as kMostTransit where an exchange has measured it.
  static constexpr std::chrono::nanoseconds kMostMeasuredTransit = std::chrono::seconds(2);
  /// A sender heard for less than this is mapped by the newest estimate at once.
  static constexpr std::chrono::nanoseconds kYoung = std::chrono::seconds(2);
  /// Then a change is taken up as by a low-pass of this time constant, and by at least 1 and at
  /// most 100 ms/s: a change of 8 ms moves what is shown of a vehicle at 20 m/s by 1 mm a frame of
  /// 60 Hz, the largest one by a tenth of its speed.
  static constexpr std::chrono::nanoseconds kTimeConstant = std::chrono::seconds(4);

  /// A clock that was once found to run ahead is followed ahead at once for so long: a replay at
  /// another speed, with silences in it.
  static constexpr std::chrono::nanoseconds kRunsAhead = std::chrono::seconds(60);

  /// Local steady time of the stamped instant, never after `now`; nullopt when refused as stale.
  /// `now`, `utc_now`: the same instant on our steady clock and in UTC [ns]. Cost: some 40 ns.
  [[nodiscard]] std::optional<std::chrono::nanoseconds> local_time(
      std::uint32_t timestamp, std::chrono::nanoseconds now, std::chrono::nanoseconds utc_now,
      const ClockEvidence& evidence = {}) noexcept;

  /// Whether the last state that was not refused has shown that the sender's clock has leapt.
  [[nodiscard]] bool has_leapt() const noexcept { return leapt_; }
  /// How fast the sender's clock falls behind ours [s/s].
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
  Nanoseconds last_sent_{0};          // the same, unwrapped, leaps taken out
  Nanoseconds last_heard_{0};         // and when it came
  Nanoseconds last_taken_{0};         // or the last one with the same timestamp
  Nanoseconds last_mapped_{0};        // and the time it was given
  Nanoseconds first_heard_{0};
  LeastTransit transit_;  // of (arrival - unwrapped time)
  LeapWatch watch_;
  Nanoseconds runs_ahead_until_{0};  // till then its being ahead again surprises nobody
  Nanoseconds base_{0};              // transit of the fastest packet, as far as known
  Nanoseconds offset_{0};            // local time - unwrapped time, as used
};

}  // namespace reckon::peer
