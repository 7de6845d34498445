// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// When, on our clock, was the state true that a sender stamped on its own? Sits between the decoded
// PDU and the state table.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

namespace reckon::peer {

/// Maps one sender's DIS timestamps to local steady time.
///
/// Absolute timestamps within 5 s of our UTC are taken at their word. A sender whose clock was
/// never that close (or that stamps relative time) is mapped through the smallest transit seen in
/// the last 10 to 20 s, which takes its constant part of the delay for zero. A sender that was once
/// in tolerance and now is not has sent something stale: refused.
class SenderClock {
 public:
  /// Out of tolerance beyond this, IEEE 1278.1 (5 s ahead or behind).
  static constexpr std::chrono::nanoseconds kTolerance = std::chrono::seconds(5);

  /// Local steady time of the stamped instant, never after `now`; nullopt when refused as stale.
  /// `now`, `utc_now`: the same instant on our steady clock and in UTC [ns]. Cost: a few ns, no
  /// allocation.
  [[nodiscard]] std::optional<std::chrono::nanoseconds> local_time(
      std::uint32_t timestamp, std::chrono::nanoseconds now,
      std::chrono::nanoseconds utc_now) noexcept;

 private:
  std::chrono::nanoseconds relative(std::uint32_t timestamp, std::chrono::nanoseconds now) noexcept;

  bool synchronised_ = false;
  bool started_ = false;
  std::uint32_t last_timestamp_ = 0;
  std::chrono::nanoseconds sender_elapsed_{0};  // unwrapped sender time since the first PDU
  std::chrono::nanoseconds window_start_{0};
  std::chrono::nanoseconds offset_now_{0};   // smallest (local - sender) in this 10 s window
  std::chrono::nanoseconds offset_last_{0};  // and in the window before
};

}  // namespace reckon::peer
