// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Budget of introductions. A newcomer receives all entities of a peer. A short datagram that claims
// to come from a newcomer must not cause a hundred long ones again and again.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>

#include "reckon/pdu/seconds.hpp"

namespace reckon::aoim {

/// A token bucket in octets. It is full at first, holds one introduction of all entities or
/// kLeastBurst, and fills within a second, at most at kMostRate. An introduction may begin while
/// the bucket is not empty. Its cost may make the bucket negative, and the next introduction waits.
/// A value type; one thread, some ns.
class IntroductionBudget {
 public:
  static constexpr double kLeastBurst = 65'536.0;  ///< [octets]
  static constexpr double kLeastRate = 16'384.0;   ///< [octets/s], for peers with few entities
  static constexpr double kMostRate = 1'048'576.0;

  /// @param octets cost of one introduction of all entities, from now on
  void set_whole(double octets) noexcept {
    burst_ = std::max(octets, kLeastBurst);
    rate_ = std::clamp(octets, kLeastRate, kMostRate);
  }
  [[nodiscard]] bool may_begin(std::chrono::nanoseconds now) const noexcept {
    return now >= ready_at();
  }
  /// Earliest time for the next introduction.
  [[nodiscard]] std::chrono::nanoseconds ready_at() const noexcept {
    if (spent_ < burst_) return since_;
    // Rounded up, so that the budget is positive then.
    return since_ + pdu::from_seconds((spent_ - burst_) / rate_) + std::chrono::nanoseconds(1);
  }
  void spend(std::size_t octets, std::chrono::nanoseconds now) noexcept {
    const double filled =
        rate_ * pdu::to_seconds(std::max(now - since_, std::chrono::nanoseconds(0)));
    spent_ = std::max(0.0, spent_ - filled) + static_cast<double>(octets);
    since_ = std::max(since_, now);
  }

 private:
  double burst_ = kLeastBurst;  // [octets]
  double rate_ = kLeastRate;    // [octets/s]
  double spent_ = 0.0;          // of burst_, at since_
  std::chrono::nanoseconds since_{0};
};

}  // namespace reckon::aoim
