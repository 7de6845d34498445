// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What introductions may cost: whoever joins, or says that it does, receives all that a peer
// owns, and one short datagram must not cause a hundred long ones again and again.
#pragma once

#include <chrono>
#include <cstddef>

namespace reckon::aoim {

/// A token bucket in octets. It is full at first, holds one whole introduction or kLeastBurst, and
/// fills within a second, but with kMostRate at most. While anything is in it an introduction may
/// begin; what that costs is taken out, also what is not there, and the next one waits for it. A
/// value; one thread, some ns.
class IntroductionBudget {
 public:
  static constexpr double kLeastBurst = 65'536.0;  ///< [octets]
  static constexpr double kLeastRate = 16'384.0;   ///< [octets/s]: of those who own little
  static constexpr double kMostRate = 1'048'576.0;

  /// @param octets that one introduction of everything costs, from now on
  void set_whole(double octets) noexcept;
  [[nodiscard]] bool may_begin(std::chrono::nanoseconds now) const noexcept {
    return now >= ready_at();
  }
  /// When an introduction may begin at the earliest.
  [[nodiscard]] std::chrono::nanoseconds ready_at() const noexcept;
  void spend(std::size_t octets, std::chrono::nanoseconds now) noexcept;

 private:
  double burst_ = kLeastBurst;  // [octets]
  double rate_ = kLeastRate;    // [octets/s]
  double spent_ = 0.0;          // of burst_, at since_
  std::chrono::nanoseconds since_{0};
};

}  // namespace reckon::aoim
