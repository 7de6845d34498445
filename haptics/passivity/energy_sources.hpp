// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Bounded energy of regions for a device: a loan for their potentials and a power for their
// oscillations. Proof: docs/haptic_stability.md.
#pragma once

#include <algorithm>

namespace reckon::haptics {

/// One loan of a port for the potentials of all its regions. It only goes into their storage, so it
/// cannot be given away. Energy that a potential releases without motion of the hand repays it, as
/// soon as pending forces no longer need that energy. So leaving and entering again gains nothing.
class RegionLoan {
 public:
  /// Greatest loan outstanding [J] >= 0.
  void limit(double most) noexcept { most_ = std::max(0.0, most); }
  /// Lends at most `wanted` [J]. @return the energy that a potential may store [J]
  [[nodiscard]] double lend(double wanted) noexcept {
    const double lent = std::clamp(wanted, 0.0, room());
    owed_ += lent;
    return lent;
  }
  /// Marks energy that a potential released to the ledger as due [J] >= 0.
  void expect(double energy) noexcept { due_ = std::min(owed_, due_ + energy); }
  /// Pays the due energy out of `there` [J] >= 0. @return the energy paid
  [[nodiscard]] double pay_due(double there) noexcept {
    const double paid = std::min(due_, there);
    repay(paid);
    return paid;
  }
  /// Repays at most `energy` [J] >= 0, which nothing else may use.
  void repay(double energy) noexcept {
    owed_ -= std::min(energy, owed_);
    due_ = std::min(owed_, std::max(0.0, due_ - energy));
  }
  /// The released energy is lost; the loan stays owed.
  void forget_due() noexcept { due_ = 0.0; }
  [[nodiscard]] double owed() const noexcept { return owed_; }
  [[nodiscard]] double room() const noexcept { return std::max(0.0, most_ - owed_); }

 private:
  double most_ = 0.0;
  double owed_ = 0.0;
  double due_ = 0.0;  // due part of owed_
};

/// Pays for the oscillations of all regions at a port, and for nothing else. In total it spends at
/// most its capacity plus power times time.
class OscillationBucket {
 public:
  /// @param power [W] >= 0 @param capacity [J] >= 0; initially full
  void limit(double power, double capacity) noexcept {
    power_ = power;
    level_ = capacity_ = capacity;
  }
  void wait(double dt) noexcept {
    level_ = std::min(capacity_, level_ + power_ * dt);
    if (in_hand_ > 0) in_hand_ -= in_hand_ * std::min(1.0, dt / kForget);
  }
  /// Books the `work` of an oscillation on the hand [J]; negative work returns.
  /// @return the missing energy [J] >= 0
  [[nodiscard]] double spend(double work) noexcept {
    const double paid = std::clamp(work, level_ - capacity_, level_);
    level_ -= paid;
    spent_ += paid;
    in_hand_ = std::max(0.0, in_hand_ + work);
    return std::max(0.0, work - paid);
  }
  /// Whether the hand has energy of it that is neither returned nor dissipated.
  [[nodiscard]] bool is_in_hand() const noexcept { return in_hand_ > 0; }
  /// The oscillation's part of a damping loss [J], which is not credited.
  [[nodiscard]] double take_from_loss(double loss) noexcept {
    const double part = std::clamp(loss, 0.0, in_hand_);
    in_hand_ -= part;
    return part;
  }
  /// Rendered share of an oscillation [0, 1]: it falls when the bucket is less than half full.
  [[nodiscard]] double share() const noexcept {
    return capacity_ > 0 ? std::min(1.0, 2.0 * level_ / capacity_) : 0.0;
  }
  [[nodiscard]] double level() const noexcept { return level_; }
  [[nodiscard]] double spent() const noexcept { return spent_; }

 private:
  static constexpr double kForget = 0.5;  // [s]

  double power_ = 0.0, capacity_ = 0.0, level_ = 0.0;
  double spent_ = 0.0;    // minus the returned energy
  double in_hand_ = 0.0;  // recent part of spent_, neither returned nor dissipated
};

}  // namespace reckon::haptics
