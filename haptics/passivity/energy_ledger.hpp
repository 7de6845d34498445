// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The purse of one contact: energy that was absorbed and may be spent again, never more.
#pragma once

#include <algorithm>
#include <cmath>

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

  /// Largest force [N] that belongs to no storage and may be held for one sample. Over a motion dx
  /// it costs F.dx - c |dx|^2, at most F^2 / (4 c): no more than is in hand while F^2 <= 4 c level.
  /// @param spare c [N/m], > 0: the damping that pays over the sample's length, less half the
  /// stiffness of the springs that are held with the force
  [[nodiscard]] double coverable_force(double spare) const noexcept {
    return std::sqrt(4.0 * spare * std::max(0.0, level_));
  }

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
