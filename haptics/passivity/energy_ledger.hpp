// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The purse of one contact: energy that was absorbed and may be spent again, never more.
#pragma once

#include <algorithm>

namespace reckon::haptics {

/// Energy [J] that a contact has in hand. The level is >= 0 whenever a step is over; in between, a
/// loss that the sampled bound does not cover (a late servo, say) shows as debt until it is
/// settled.
class EnergyLedger {
 public:
  /// @param limit [J], > 0; default 0.02. Higher lets more energy come back at once after a rest
  /// (stronger kicks), lower makes moving surfaces lag.
  explicit EnergyLedger(double limit = 0.02) noexcept : limit_(limit) {}

  /// Books energy in (positive) or out (negative); what exceeds the limit is thrown away.
  void book(double energy) noexcept { level_ = std::min(limit_, level_ + energy); }

  /// Takes out what was granted before; never leaves a rounding debt.
  void spend(double energy) noexcept { level_ = std::min(limit_, std::max(0.0, level_ - energy)); }

  /// Forgets everything in hand.
  void clear() noexcept { level_ = 0.0; }

  [[nodiscard]] double level() const noexcept { return level_; }
  [[nodiscard]] double debt() const noexcept { return std::max(0.0, -level_); }
  [[nodiscard]] double room() const noexcept { return limit_ - std::max(0.0, level_); }
  [[nodiscard]] double limit() const noexcept { return limit_; }

 private:
  double limit_;
  double level_ = 0.0;
};

}  // namespace reckon::haptics
