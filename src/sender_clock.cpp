// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sender_clock.hpp"

#include <algorithm>

#include "pdu/timestamp.hpp"

namespace reckon::peer {
namespace {
constexpr std::chrono::nanoseconds kWindow = std::chrono::seconds(10);
}

std::optional<std::chrono::nanoseconds> SenderClock::local_time(
    std::uint32_t timestamp, std::chrono::nanoseconds now,
    std::chrono::nanoseconds utc_now) noexcept {
  if (pdu::is_absolute(timestamp)) {
    const auto age = utc_now - pdu::nearest_instant(timestamp, utc_now);
    if (age <= kTolerance && age >= -kTolerance) {
      synchronised_ = true;
      return now - std::max(age, std::chrono::nanoseconds(0));
    }
    if (synchronised_) return std::nullopt;
  }
  return relative(timestamp, now);
}

std::chrono::nanoseconds SenderClock::relative(std::uint32_t timestamp,
                                               std::chrono::nanoseconds now) noexcept {
  if (started_) {
    sender_elapsed_ += pdu::difference(timestamp, last_timestamp_);
  }
  last_timestamp_ = timestamp;
  const auto offset = now - sender_elapsed_;
  if (!started_) {
    started_ = true;
    offset_now_ = offset_last_ = offset;
    window_start_ = now;
  }

  // A fresh window every 10 s lets the estimate follow a slow drift of either clock.
  if (now - window_start_ > kWindow) {
    offset_last_ = offset_now_;
    offset_now_ = offset;
    window_start_ = now;
  }
  offset_now_ = std::min(offset_now_, offset);
  return std::min(now, sender_elapsed_ + std::min(offset_now_, offset_last_));
}

}  // namespace reckon::peer
