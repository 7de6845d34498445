// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Keeps the queue short between a sending socket and a wire that takes less than is sent: what is
// new must not wait behind what is old. Private to the peer library.
#pragma once

#include <chrono>
#include <cstddef>

namespace reckon::peer {

/// Learns from the octets that wait in the kernel how fast they leave, and holds back what would
/// have to wait for longer than kLongest. One thread; no clock, no allocation.
class SendPace {
 public:
  static constexpr std::chrono::nanoseconds kLongest = std::chrono::milliseconds(50);
  /// So long the queue has to last before its rate is known, and so long the rate is then believed.
  static constexpr std::chrono::nanoseconds kLearn = std::chrono::milliseconds(20);
  static constexpr std::chrono::nanoseconds kRenew = std::chrono::milliseconds(500);

  /// Before a send. @param queued octets that wait in the kernel, as the kernel charges them
  /// @returns false where another datagram would wait too long: drop it, a newer state follows
  [[nodiscard]] bool may_send(std::size_t queued, std::chrono::nanoseconds now) noexcept {
    if (queued == 0) {
      watching_ = false;
      return true;
    }
    if (!watching_) start(queued, now);
    const std::chrono::nanoseconds lasted = now - since_;
    const double left = static_cast<double>(entered_) - static_cast<double>(queued);
    // Where nothing has left the host may have been busy: a rate of zero needs as long as what
    // waits may wait.
    if (lasted >= (left > 0 ? kLearn : kLongest)) {
      rate_ = left / std::chrono::duration<double>(lasted).count();
      known_ = true;
    }
    const bool may = is_short(queued);
    if (lasted >= kRenew) start(queued, now);
    return may;
  }
  /// Whether what is sent behind so many octets waits no longer than it may, by the rate known.
  [[nodiscard]] bool is_short(std::size_t queued) const noexcept {
    return !known_ ||
           static_cast<double>(queued) <= rate_ * std::chrono::duration<double>(kLongest).count();
  }
  /// After a send that went while octets waited. @param grown by so many of them
  void sent(std::size_t grown) noexcept { entered_ += grown; }

 private:
  void start(std::size_t queued, std::chrono::nanoseconds now) noexcept {
    if (!watching_) known_ = false;
    watching_ = true;
    since_ = now;
    entered_ = queued;
  }

  bool watching_ = false;  // octets have waited at every send since `since_`
  bool known_ = false;
  std::chrono::nanoseconds since_{0};
  std::size_t entered_ = 0;  // octets that waited then, and those that came since
  double rate_ = 0;          // [octets/s] at which they leave
};

}  // namespace reckon::peer
