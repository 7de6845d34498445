// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Keeps the queue short between a sending socket and a slower wire: new datagrams must not wait
// behind old ones. Private to the peer library.
#pragma once

#include <chrono>
#include <cstddef>

namespace reckon::peer {

/// Measures the sending rate from the octets pending in the kernel, and drops datagrams that would
/// wait for longer than kLongest. One thread; no clock, no allocation.
class SendPace {
 public:
  static constexpr std::chrono::nanoseconds kLongest = std::chrono::milliseconds(50);
  /// The queue has to last this long before its rate is known; the rate is then believed for the
  /// same time.
  static constexpr std::chrono::nanoseconds kLearn = std::chrono::milliseconds(20);
  static constexpr std::chrono::nanoseconds kRenew = std::chrono::milliseconds(500);

  /// Call it before a send.
  /// @param queued octets pending in the kernel, as the kernel charges them @returns false if
  /// another datagram would wait too long: drop it, a newer state follows
  [[nodiscard]] bool may_send(std::size_t queued, std::chrono::nanoseconds now) noexcept {
    if (queued == 0) {
      watching_ = false;
      return true;
    }
    if (!watching_) start(queued, now);
    const std::chrono::nanoseconds lasted = now - since_;
    const double left = static_cast<double>(entered_) - static_cast<double>(queued);
    // If nothing was sent, the host may have been busy: a rate of zero needs as long as the longest
    // wait.
    if (lasted >= (left > 0 ? kLearn : kLongest)) {
      rate_ = left / std::chrono::duration<double>(lasted).count();
      known_ = true;
    }
    const bool may = is_short(queued);
    if (lasted >= kRenew) start(queued, now);
    return may;
  }
  /// Whether datagrams behind this many octets wait no longer than they may, at the known rate.
  [[nodiscard]] bool is_short(std::size_t queued) const noexcept {
    return !known_ ||
           static_cast<double>(queued) <= rate_ * std::chrono::duration<double>(kLongest).count();
  }
  /// Records a send while octets were pending.  @param grown the octets added
  void sent(std::size_t grown) noexcept { entered_ += grown; }

 private:
  void start(std::size_t queued, std::chrono::nanoseconds now) noexcept {
    if (!watching_) known_ = false;
    watching_ = true;
    since_ = now;
    entered_ = queued;
  }

  bool watching_ = false;  // octets were pending at every send since `since_`
  bool known_ = false;
  std::chrono::nanoseconds since_{0};
  std::size_t entered_ = 0;  // octets pending at that time, and those added since
  double rate_ = 0;          // [octets/s] at which they are sent
};

}  // namespace reckon::peer
