// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// UTC that never jumps: for this peer's timestamps and for arrivals, independent of changes of the
// host's clock. Between the Clock and the model loop.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

namespace reckon::peer {

/// Follows the host's UTC by slewing, and continues without it after a jump. One thread; no
/// allocation; a few ns a call.
class SteadyUtc {
 public:
  /// A larger change of the host's UTC against its steady clock is a jump. A reading is rarely off
  /// by this much (the reader was preempted between the two clocks); NTP corrects smaller
  /// differences by slewing, which is followed.
  static constexpr std::chrono::nanoseconds kStep = std::chrono::milliseconds(128);
  /// Least duration of a jump, so that one late reading does not count as a jump.
  static constexpr std::chrono::nanoseconds kHold = std::chrono::milliseconds(500);
  /// Greatest rate at which the difference to the host is reduced [ppm], NTP's own.
  static constexpr std::int64_t kSlewPpm = 500;

  /// UTC at steady time `now`, when the host's clock shows `host_utc`. Rises with `now`, at a rate
  /// within kSlewPpm of it. The first call trusts the host. `now` must not fall.
  std::chrono::nanoseconds at(std::chrono::nanoseconds now,
                              std::chrono::nanoseconds host_utc) noexcept;

  /// Whether this is the host's UTC within kStep, so that timestamps may be absolute.
  [[nodiscard]] bool is_aligned() const noexcept;
  /// The jump that the last call of at() has found, forward positive.
  [[nodiscard]] std::optional<std::chrono::nanoseconds> leap() const noexcept { return leap_; }

 private:
  void follow(std::chrono::nanoseconds host_offset, std::chrono::nanoseconds now) noexcept;

  // Offsets are UTC minus steady time.
  bool started_ = false;
  std::chrono::nanoseconds last_{0};
  std::chrono::nanoseconds offset_{0};    // ours
  std::chrono::nanoseconds followed_{0};  // the host's, towards which ours is slewed
  std::chrono::nanoseconds suspect_{0};   // the host's after an apparent jump
  std::optional<std::chrono::nanoseconds> suspect_since_;
  std::optional<std::chrono::nanoseconds> leap_;
};

}  // namespace reckon::peer
