// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Energy that regions put into a device by themselves, bounded: a loan for their potentials and a
// power for their oscillations. Proof: docs/haptic_stability.md.
#pragma once

#include <algorithm>

namespace reckon::haptics {

/// One loan of a port for the potentials of all its regions. It goes into their storage alone, so
/// that nothing can give it away. What a potential releases without a motion of the hand repays it,
/// as soon as the forces under way to the handle no longer need that energy; so leaving and
/// entering grants nothing new.
class RegionLoan {
 public:
  /// Greatest loan outstanding [J] >= 0.
  void limit(double most) noexcept { most_ = std::max(0.0, most); }
  /// Lends at most `wanted` [J]. @return what a potential may store
  [[nodiscard]] double lend(double wanted) noexcept {
    const double lent = std::clamp(wanted, 0.0, room());
    owed_ += lent;
    return lent;
  }
  /// A potential released this to the ledger [J] >= 0: it is due.
  void expect(double energy) noexcept { due_ = std::min(owed_, due_ + energy); }
  /// Pays what is due out of `there` [J] >= 0. @return what was paid
  [[nodiscard]] double pay_due(double there) noexcept {
    const double paid = std::min(due_, there);
    repay(paid);
    return paid;
  }
  /// Pays at most `energy` [J] >= 0 that nobody else can have.
  void repay(double energy) noexcept {
    owed_ -= std::min(energy, owed_);
    due_ = std::min(owed_, std::max(0.0, due_ - energy));
  }
  /// What was released is gone; the loan stays owed.
  void forget_due() noexcept { due_ = 0.0; }
  [[nodiscard]] double owed() const noexcept { return owed_; }
  [[nodiscard]] double room() const noexcept { return std::max(0.0, most_ - owed_); }

 private:
  double most_ = 0.0;
  double owed_ = 0.0;
  double due_ = 0.0;  // of that
};

/// What pays for the oscillations of all regions at a port, and for nothing else. Since the start
/// it spends at most its capacity plus power times time.
class OscillationBucket {
 public:
  /// @param power [W] >= 0  @param capacity [J] >= 0; it begins full
  void limit(double power, double capacity) noexcept {
    power_ = power;
    level_ = capacity_ = capacity;
  }
  void wait(double dt) noexcept {
    level_ = std::min(capacity_, level_ + power_ * dt);
    if (in_hand_ > 0) in_hand_ -= in_hand_ * std::min(1.0, dt / kForget);
  }
  /// An oscillation did `work` on the hand [J]; below 0 it comes back.
  /// @return what lacks [J] >= 0
  [[nodiscard]] double spend(double work) noexcept {
    const double paid = std::clamp(work, level_ - capacity_, level_);
    level_ -= paid;
    spent_ += paid;
    in_hand_ = std::max(0.0, in_hand_ + work);
    return std::max(0.0, work - paid);
  }
  /// Whether the hand has some of it, neither back nor lost.
  [[nodiscard]] bool is_in_hand() const noexcept { return in_hand_ > 0; }
  /// The part of a damping loss that the oscillation brought [J]: it earns no one energy.
  [[nodiscard]] double take_from_loss(double loss) noexcept {
    const double part = std::clamp(loss, 0.0, in_hand_);
    in_hand_ -= part;
    return part;
  }
  /// Share of an oscillation that is shown [0, 1]: it falls as the bucket empties below a half.
  [[nodiscard]] double share() const noexcept {
    return capacity_ > 0 ? std::min(1.0, 2.0 * level_ / capacity_) : 0.0;
  }
  [[nodiscard]] double level() const noexcept { return level_; }
  [[nodiscard]] double spent() const noexcept { return spent_; }

 private:
  static constexpr double kForget = 0.5;  // [s]

  double power_ = 0.0, capacity_ = 0.0, level_ = 0.0;
  double spent_ = 0.0;    // less what came back
  double in_hand_ = 0.0;  // of that, lately, and neither back nor lost
};

}  // namespace reckon::haptics
