// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The energy of one haptic device: input of the hand, gifts of others, loans. energy_port.hpp has
// the forces that may be held with it.
#pragma once

#include <algorithm>
#include <limits>

#include "reckon/haptics/passivity/energy_sources.hpp"

namespace reckon::haptics {

/// One level E for all contacts of a device, which includes the storage of the springs that others
/// move. It contains only energies: no force, no axis. One thread; O(1); allocates nothing.
class EnergyLedger {
 public:
  /// Energy credited without observation [J], and the power at which this credit refills [W]. A
  /// higher value hinders honest peers less if the shown surface lags behind their real one, and
  /// allows a dishonest peer more.
  static constexpr double kUnseen = 0.005;
  static constexpr double kUnseenPower = 0.05;

  /// Greatest energy from all others together at once [J], beyond received_power() over time. It
  /// limits their part of E that no spring stores, and a single credit. A higher value lets a quick
  /// blow arrive whole, and a dishonest peer throw a hand that much harder.
  static constexpr double kReceivedAtOnce = 0.008;
  /// Greatest energy kept beside the springs' storage [J]. At most kReceivedAtOnce of it may come
  /// from others than the hand. A higher value returns more at once after a rest (stronger kicks);
  /// a lower value makes moving surfaces softer.
  static constexpr double kMostKept = 0.04;

  /// Greatest power from all others together, minus the energy given to them [W] > 0; unlimited at
  /// first. Excess energy is not lost but stays pending: see receivable().
  void limit_received_power(double power) noexcept { received_power_ = power; }

  /// Books energy that a wall stored (negative) or released (positive) [J].
  void book(double energy) noexcept { level_ += energy; }
  /// Adds energy given to us. @return the part that fits [J].
  double credit(double energy) noexcept;
  /// Adds energy that a peer claims to have given. A hand at rest can only pass on what it
  /// received, and a surface that brings energy is observed to push. So energy is credited as far
  /// as it was observed. Beyond that 5 mJ are credited, which refill at 50 mW: one account for all
  /// peers, independent of their identities. The rest is lost. @param seen observed energy [J] >= 0
  double credit(double energy, double seen) noexcept;
  /// Books energy that went to others, at any level [J] >= 0; as much may be credited again.
  void give_back(double energy) noexcept;
  /// Energy that may be credited now [J], from all peers together. It grows with time, as far as
  /// there is room.
  [[nodiscard]] double receivable() const noexcept;
  /// Advances time by `dt` [s]: both accounts refill.
  void wait(double dt) noexcept;
  /// Greatest gift now [J]: 0.9 E, or E minus the energy of pending forces if that is less.
  [[nodiscard]] double greatest_gift() const noexcept;
  /// Takes `wanted` [J] for a gift, at most greatest_gift(). @return the energy taken [J].
  double give(double wanted) noexcept;
  /// Adds a loan: energy that nobody put in, and which is repaid. The caller bounds it. @param
  /// energy [J] >= 0
  void borrow(double energy) noexcept;
  /// Repays at most the debt, but keeps the energy that pays for pending forces. @param energy [J]
  /// >= 0
  void pay_back(double energy) noexcept;

  /// The loan for the potentials of regions, separate from E.
  [[nodiscard]] RegionLoan& region_loan() noexcept { return region_loan_; }
  [[nodiscard]] const RegionLoan& region_loan() const noexcept { return region_loan_; }
  /// Repays the due part of the loan for regions, but keeps the energy that pays for pending
  /// forces.
  void repay_regions() noexcept { level_ -= region_loan_.pay_due(spendable()); }
  /// Pays for the oscillations of regions, separate from E.
  [[nodiscard]] OscillationBucket& oscillations() noexcept { return oscillations_; }
  [[nodiscard]] const OscillationBucket& oscillations() const noexcept { return oscillations_; }

  /// E [J]; below 0 only after a late sample or a wall that cost more than was available.
  [[nodiscard]] double level() const noexcept { return level_; }
  [[nodiscard]] double debt() const noexcept { return level_ < 0 ? -level_ : 0.0; }
  /// Debt: borrowed and not yet repaid [J].
  [[nodiscard]] double owed() const noexcept { return owed_; }
  /// Energy in no spring [J], after the last hold().
  [[nodiscard]] double free() const noexcept { return level_ - booked_; }
  /// Energy that the hand put in, plus the certain loss in the device's damping, since the start
  /// [J].
  [[nodiscard]] double absorbed() const noexcept { return absorbed_; }

 protected:
  EnergyLedger() = default;
  EnergyLedger(const EnergyLedger&) = default;
  EnergyLedger& operator=(const EnergyLedger&) = default;
  ~EnergyLedger() = default;

  void absorb(double energy) noexcept {
    level_ += energy;
    absorbed_ += energy;
  }
  // Books the work of an oscillation on the hand: the bucket pays for it, and E for the rest.
  void shake(double work) noexcept {
    absorbed_ -= work;
    level_ -= oscillations_.spend(work);
  }
  // Removes the oscillations' part of an absorbed damping loss.
  void forgo_loss(double loss) noexcept {
    if (!oscillations_.is_in_hand()) return;
    level_ -= oscillations_.take_from_loss(std::min(loss, std::max(0.0, level_)));
  }
  void take_back(double energy) noexcept {
    const double back = std::clamp(energy, 0.0, pushed_);
    unearned_ += back;
    pushed_ -= back;
  }
  [[nodiscard]] double waiting() const noexcept;
  [[nodiscard]] double spendable() const noexcept { return std::max(0.0, level_ - committed_); }

  double level_ = 0.0;
  double booked_ = 0.0;     // w S of the last hold
  double committed_ = 0.0;  // of level_, pays for pending forces
  double unearned_ = 0.0;   // of level_, given by others
  double pushed_ = 0.0;     // of unearned_, spent on the hand and not returned

 private:
  double owed_ = 0.0;
  double unseen_ = kUnseen;
  double received_power_ = std::numeric_limits<double>::infinity();
  double receivable_ = kReceivedAtOnce;
  double absorbed_ = 0.0;
  RegionLoan region_loan_;
  OscillationBucket oscillations_;
};

}  // namespace reckon::haptics
