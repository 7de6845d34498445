// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Time of sealing of a sender's datagram by our clock. Only this time proves for each single
// datagram that it is not a recording.
#pragma once

#include <chrono>
#include <cstdint>

namespace reckon::peer {

/// The stamps of one sender on our clock, relative to the recent datagram with the shortest delay.
/// An attacker can make datagrams late by holding them back, but cannot make one arrive before it
/// was sealed. A clock drift of 0.1 % causes an error of 8 ms. A value; some ns a call.
class SenderTime {
 public:
  using Nanoseconds = std::chrono::nanoseconds;
  /// Largest delay relative to the fastest datagram; a later one is refused as outdated.
  static constexpr Nanoseconds kOldest = std::chrono::seconds(1);
  /// The fastest datagram is forgotten after one to two periods of this length.
  static constexpr Nanoseconds kWindow = std::chrono::seconds(4);

  /// Makes a datagram that is known to be live the reference.
  void begin(std::uint32_t stamp, Nanoseconds received) noexcept {
    least_ = window_ = {stamp, received};
    begun_ = received;
  }

  /// Records an accepted datagram.
  void note(std::uint32_t stamp, Nanoseconds received) noexcept {
    const Arrived now{stamp, received};
    if (received - begun_ > kWindow) {
      least_ = window_;
      window_ = now;
      begun_ = received;
    }
    if (lag(window_, now) <= Nanoseconds(0)) window_ = now;
    if (lag(least_, now) <= Nanoseconds(0)) least_ = now;
  }

  /// Delay of a datagram relative to the fastest one.
  [[nodiscard]] Nanoseconds lag(std::uint32_t stamp, Nanoseconds received) const noexcept {
    return lag(least_, {stamp, received});
  }

  /// Whether an arrival is impossible: a clock has jumped or stopped, or the datagram is a
  /// recording.
  [[nodiscard]] bool is_far(std::uint32_t stamp, Nanoseconds received) const noexcept {
    const Nanoseconds late = lag(stamp, received);
    return late > kOldest || late < -kOldest;
  }

  /// Whether it was sealed at most kOldest before its arrival and not before `since`, with the
  /// fastest delay as tolerance.
  [[nodiscard]] bool is_timely(std::uint32_t stamp, Nanoseconds received,
                               Nanoseconds since) const noexcept {
    const Nanoseconds late = lag(stamp, received);
    return !is_far(stamp, received) && (late <= Nanoseconds(0) || received - late >= since);
  }

 private:
  struct Arrived {
    std::uint32_t stamp{0};  // [us], modulo 2^32
    Nanoseconds received{0};
  };
  // Both less than half an hour apart.
  static Nanoseconds lag(const Arrived& first, const Arrived& second) noexcept {
    const auto between = static_cast<std::int32_t>(second.stamp - first.stamp);
    return second.received - first.received - std::chrono::microseconds(between);
  }

  Arrived least_, window_;
  Nanoseconds begun_{0};
};

}  // namespace reckon::peer
