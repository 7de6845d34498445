// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The only source of time. The four loops receive the time as an argument; only the threads that
// call them, and the transport, hold a Clock.
#pragma once

#include <atomic>
#include <chrono>

namespace reckon::peer {

/// A steady time for measuring and a UTC time for the wire. Both functions may be called by any
/// thread, allocate nothing and do not block.
class Clock {
 public:
  virtual ~Clock() = default;

  /// Time that never steps back, since an arbitrary epoch.
  [[nodiscard]] virtual std::chrono::nanoseconds now() const noexcept = 0;
  /// Time since 1970-01-01 00:00 UTC; may jump when the host's clock is set.
  [[nodiscard]] virtual std::chrono::nanoseconds utc_now() const noexcept = 0;
};

/// The host's clocks: CLOCK_MONOTONIC and CLOCK_REALTIME. About 25 ns a call.
class SteadyClock final : public Clock {
 public:
  [[nodiscard]] std::chrono::nanoseconds now() const noexcept override;
  [[nodiscard]] std::chrono::nanoseconds utc_now() const noexcept override;
};

/// A clock that moves only when it is set, for tests and for replays.
class ManualClock final : public Clock {
 public:
  /// Starts at steady time `start`; UTC runs `utc_offset` ahead of it.
  explicit ManualClock(std::chrono::nanoseconds start = std::chrono::nanoseconds{0},
                       std::chrono::nanoseconds utc_offset = std::chrono::nanoseconds{0}) noexcept;

  [[nodiscard]] std::chrono::nanoseconds now() const noexcept override;
  [[nodiscard]] std::chrono::nanoseconds utc_now() const noexcept override;

  /// Moves forward by `step`, which must not be negative (assert).
  void advance(std::chrono::nanoseconds step) noexcept;
  /// Jumps to `time`, which must not be before now() (assert).
  void set(std::chrono::nanoseconds time) noexcept;

 private:
  std::atomic<std::chrono::nanoseconds::rep> now_;
  std::chrono::nanoseconds utc_offset_;
};

}  // namespace reckon::peer
