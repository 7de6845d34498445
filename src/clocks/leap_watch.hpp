// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Distinguishes a jump of a sender's clock from a stray packet: a jump lasts.
#pragma once

#include <algorithm>
#include <chrono>

namespace reckon::peer {

/// Watches packets whose send times do not fit their arrivals. One thread, no allocation.
class LeapWatch {
 public:
  /// Differences "arrival - sending" within this of the first one belong to the same jump. It
  /// exceeds the jitter of any usable network; only a queue that empties after an outage spreads
  /// more.
  static constexpr std::chrono::nanoseconds kAgree = std::chrono::milliseconds(500);
  /// A smaller difference is a delay, or is corrected by slewing.
  static constexpr std::chrono::nanoseconds kOdd = std::chrono::seconds(1);

  /// Records a packet that does not fit. True if enough of them agree: three over a quarter of a
  /// second or more, or two over a second or more (senders of few updates). A packet that is not
  /// newer than another agreeing one is a copy, or was overtaken, and proves nothing.
  /// @param now must not fall.
  /// @param ahead whether it arrived sooner after its sending than any network can explain. Two
  /// such packets in a row, the second newer than the first, are enough. Such a clock was set
  /// forward or runs fast, as in a replay at four times the speed, whose packets need not agree
  /// with each other.
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
  /// Records a packet that fits; earlier packets that did not fit were strays.
  void clear() noexcept { count_ = 0; }

  /// Smallest difference of the packets that agree.
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
