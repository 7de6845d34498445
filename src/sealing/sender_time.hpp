// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// When a sender sealed a datagram, by our clock: what proves of each one alone that it is no
// recording.
#pragma once

#include <chrono>
#include <cstdint>

namespace reckon::peer {

/// The stamps of one sender on our clock. The one that came fastest lately leads: whoever holds
/// datagrams back makes them late, and can make none come before it was sealed. Clocks that drift
/// by 0.1 % make it wrong by 8 ms. A value; some ns a call.
class SenderTime {
 public:
  using Nanoseconds = std::chrono::nanoseconds;
  /// What came so much later than the fastest is no news.
  static constexpr Nanoseconds kOldest = std::chrono::seconds(1);
  /// What was the fastest is forgotten after one to two of these.
  static constexpr Nanoseconds kWindow = std::chrono::seconds(4);

  /// From now on this one, known to be of now, leads.
  void begin(std::uint32_t stamp, Nanoseconds received) noexcept {
    least_ = window_ = {stamp, received};
    begun_ = received;
  }

  /// One that was taken.
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

  /// So much longer it was on its way than the fastest.
  [[nodiscard]] Nanoseconds lag(std::uint32_t stamp, Nanoseconds received) const noexcept {
    return lag(least_, {stamp, received});
  }

  /// Whether it cannot have come then: a clock has leapt or stood still, or it is a recording.
  [[nodiscard]] bool is_far(std::uint32_t stamp, Nanoseconds received) const noexcept {
    const Nanoseconds late = lag(stamp, received);
    return late > kOldest || late < -kOldest;
  }

  /// Whether it was sealed no longer than kOldest before it came, and, but for the time that the
  /// fastest was on its way, not before `since`.
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
  // Of two that are less than half an hour apart.
  static Nanoseconds lag(const Arrived& first, const Arrived& second) noexcept {
    const auto between = static_cast<std::int32_t>(second.stamp - first.stamp);
    return second.received - first.received - std::chrono::microseconds(between);
  }

  Arrived least_, window_;
  Nanoseconds begun_{0};
};

}  // namespace reckon::peer
