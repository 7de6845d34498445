// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// UTC that never jumps: what this peer puts on the wire and reads arrivals by, whatever is done to
// the host's clock meanwhile. Between the Clock and the model loop.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

namespace reckon::peer {

/// Follows the host's UTC by slewing, and goes on without it when it leaps. One thread; no
/// allocation; a few ns a call.
class SteadyUtc {
 public:
  /// A change of the host's UTC against its steady clock by more than this is a leap. A reading is
  /// rarely off by so much (the reader was preempted between the two clocks), and NTP corrects what
  /// is less by slewing, which is followed.
  static constexpr std::chrono::nanoseconds kStep = std::chrono::milliseconds(128);
  /// A leap has to last so long, so that one late reading is none.
  static constexpr std::chrono::nanoseconds kHold = std::chrono::milliseconds(500);
  /// Greatest rate at which the difference to the host is worked off [ppm], NTP's own.
  static constexpr std::int64_t kSlewPpm = 500;

  /// UTC at steady time `now`, when the host says `host_utc`. Rises with `now`, at a rate within
  /// kSlewPpm of it. The first call takes the host at its word. `now` must not fall.
  std::chrono::nanoseconds at(std::chrono::nanoseconds now,
                              std::chrono::nanoseconds host_utc) noexcept;

  /// Whether this is the host's UTC within kStep: then stamps may call themselves absolute.
  [[nodiscard]] bool is_aligned() const noexcept;
  /// The leap that the last call of at() has found, forward positive.
  [[nodiscard]] std::optional<std::chrono::nanoseconds> leap() const noexcept { return leap_; }

 private:
  void follow(std::chrono::nanoseconds host_offset, std::chrono::nanoseconds now) noexcept;

  // Offsets are UTC minus steady time.
  bool started_ = false;
  std::chrono::nanoseconds last_{0};
  std::chrono::nanoseconds offset_{0};    // ours
  std::chrono::nanoseconds followed_{0};  // the host's, towards which ours is slewed
  std::chrono::nanoseconds suspect_{0};   // the host's since it seems to have leapt
  std::optional<std::chrono::nanoseconds> suspect_since_;
  std::optional<std::chrono::nanoseconds> leap_;
};

}  // namespace reckon::peer
