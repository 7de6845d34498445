// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Tells a leap of a sender's clock from a packet that strayed: a leap lasts.
#pragma once

#include <algorithm>
#include <chrono>

namespace reckon::peer {

/// Watches packets whose send times do not fit their arrivals. One thread, no allocation.
class LeapWatch {
 public:
  /// Differences "arrival - sending" no farther from the first one tell of the same leap. Below it
  /// lies the jitter of any usable network; a queue that empties after an outage spreads more.
  static constexpr std::chrono::nanoseconds kAgree = std::chrono::milliseconds(500);
  /// What is off by less than this is delay, or made up for by slewing.
  static constexpr std::chrono::nanoseconds kOdd = std::chrono::seconds(1);

  /// Notes a packet that does not fit; true when enough of them agree: three in a quarter of a
  /// second or more, or two in a second or more (senders of few updates). One that is no newer than
  /// another that agrees is a copy, or was overtaken: it tells nothing. `now` must not fall.
  /// `ahead`: it was sent sooner than any network explains. Two of these in a row, the second newer
  /// than the first, are enough: a clock that was set forward or runs fast, as in a replay at four
  /// times the speed, whose packets need not agree with each other.
  [[nodiscard]] bool confirms(std::chrono::nanoseconds difference, std::chrono::nanoseconds now,
                              bool ahead = false) noexcept {
    const bool newer = count_ == 0 || now - difference > last_sent_;
    const bool runs_on = ahead && was_ahead_ && count_ > 0 && newer;
    was_ahead_ = ahead;
    if (count_ == 0 || std::chrono::abs(difference - first_) > kAgree) {
      count_ = 0;
      since_ = now;
      first_ = least_ = difference;
    } else if (!newer) {
      return false;
    }
    last_sent_ = now - difference;
    ++count_;
    least_ = std::min(least_, difference);
    return runs_on || (count_ >= 3 && now - since_ >= std::chrono::milliseconds(250)) ||
           (count_ >= 2 && now - since_ >= std::chrono::seconds(1));
  }
  /// A packet did fit: what did not was a stray.
  void clear() noexcept { count_ = 0; }

  /// Smallest difference of those that agree.
  [[nodiscard]] std::chrono::nanoseconds least() const noexcept { return least_; }

 private:
  int count_ = 0;
  bool was_ahead_ = false;
  std::chrono::nanoseconds last_sent_{0};
  std::chrono::nanoseconds since_{0};
  std::chrono::nanoseconds first_{0};
  std::chrono::nanoseconds least_{0};
};

}  // namespace reckon::peer
