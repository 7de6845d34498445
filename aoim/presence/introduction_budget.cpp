// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/presence/introduction_budget.hpp"

#include <algorithm>

#include "reckon/pdu/seconds.hpp"

namespace reckon::aoim {

using std::chrono::nanoseconds;

void IntroductionBudget::set_whole(double octets) noexcept {
  burst_ = std::max(octets, kLeastBurst);
  rate_ = std::clamp(octets, kLeastRate, kMostRate);
}

nanoseconds IntroductionBudget::ready_at() const noexcept {
  if (spent_ < burst_) return since_;
  // Rounded up, so that the budget is positive then.
  return since_ + pdu::from_seconds((spent_ - burst_) / rate_) + nanoseconds(1);
}

void IntroductionBudget::spend(std::size_t octets, nanoseconds now) noexcept {
  const double filled = rate_ * pdu::to_seconds(std::max(now - since_, nanoseconds(0)));
  spent_ = std::max(0.0, spent_ - filled) + static_cast<double>(octets);
  since_ = std::max(since_, now);
}

}  // namespace reckon::aoim
