// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The one ledger of a haptic device: what the hand put in, what others gave, and the force that may
// be held with it. Whatever the contacts show, in whatever order, the hand never gets more energy
// out of the device than is in here. Proof: docs/haptic_stability.md.
#pragma once

#include <Eigen/Core>

#include "reckon/haptics/passivity/split.hpp"

namespace reckon::haptics {

/// What the contacts of a device want to be held for the next sample.
struct PortLoad {
  /// Springs of the static scene [N]; what they store is out of the ledger already, see book().
  Eigen::Vector3d walls = Eigen::Vector3d::Zero();
  double walls_slope = 0.0;  ///< [N/m], upper bound of their curvature
  /// Sum of the springs that others move [N]: forces that cancel cost nothing.
  Eigen::Vector3d springs = Eigen::Vector3d::Zero();
  double stored = 0.0;         ///< [J], the sum of what they would store
  double springs_slope = 0.0;  ///< [N/m], greatest eigenvalue of the sum of their curvature bounds
  /// What belongs to no storage: dampers, effects [N].
  Eigen::Vector3d extra = Eigen::Vector3d::Zero();
};

/// What of it can be held.
struct PortHold {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< [N]
  double weight = 0.0;                              ///< share of `stored` that is booked
  double springs = 1.0;                             ///< share of the springs that is shown
  double extra = 1.0;                               ///< share of the extra force
};

/// Energy of one device. Order of calls within a servo step: settle, then any of book, credit, give
/// and borrow, then hold, then attenuate if the force must shrink. The force is taken to be held
/// until the next settle().
///
/// Springs that others move are paid from one level E that holds their storage too: it changes by
/// the work of the hand and the device's damping alone, wherever their surfaces go. hold() chooses
/// what E can answer for over any motion of the next sample. O(1), no allocation.
class EnergyPort {
 public:
  /// Believed without being seen [J], and how fast that comes again [W]. Higher hinders honest play
  /// less where the shown surface lags behind what its owner does, and lets a liar do more.
  static constexpr double kUnseen = 0.005;
  static constexpr double kUnseenPower = 0.05;

  /// @param damping [N s/m] >= 0, the device's sure damping  @param limit [J] > 0, most that is
  /// kept beside what the springs store. Higher lets more come back at once after a rest (stronger
  /// kicks), lower makes moving surfaces softer.
  explicit EnergyPort(double damping, double limit = 0.04) noexcept
      : damping_(damping), limit_(limit) {}

  /// Books the sample that ended: the hand moved by dx [m] in dt [s] > 0 under the held force.
  void settle(const Eigen::Vector3d& dx, double dt) noexcept;
  /// Books what a wall took in storage (negative) or gave back (positive) [J], or work that is
  /// known only later.
  void book(double energy) noexcept { level_ += energy; }
  /// Adds energy that was given to us. @return what there was room for [J].
  double credit(double energy) noexcept;
  /// Adds energy that somebody only says to have given us. Who stands still has nothing to give but
  /// what was given to him: the hand behind a surface that brings energy is seen to push. So it is
  /// believed as far as it was seen, and 5 mJ beyond that, which come again at 50 mW: one such
  /// account for all, whatever they call themselves. The rest is lost. @param seen [J] >= 0
  double credit(double energy, double seen) noexcept;
  /// Time passes [s]: that account fills again.
  void wait(double dt) noexcept;
  /// Takes min(wanted, 0.9 E) to give it away. @return that [J].
  double give(double wanted) noexcept;
  /// Adds energy that nobody put in, to be paid back; the caller bounds it. @param energy [J] >= 0
  void borrow(double energy) noexcept;
  /// Pays back, at most what is owed. @param energy [J] >= 0, and at most E
  void pay_back(double energy) noexcept;

  /// Chooses what to hold for the next dt [s], and throws away what the limit does not let keep.
  PortHold hold(const PortLoad& load, double dt) noexcept;
  /// Holds `force` [N] in place of what hold() chose for the same load: one that lags behind it is
  /// a rest like any other. @return false, and nothing changes, where E cannot answer for it.
  bool hold_instead(const PortLoad& load, const Eigen::Vector3d& force, double dt) noexcept;
  /// The force is scaled by `factor` in [0, 1] on its way to the device.
  void attenuate(double factor) noexcept { held_ *= factor; }
  /// The device dropped the force by itself.
  void let_go() noexcept { held_.setZero(); }
  /// Forgets all energy: what the hand took since is not known. What is owed stays owed.
  void clear() noexcept;

  /// E [J]; below 0 only after a sample that was late or a wall that cost more than was there.
  [[nodiscard]] double level() const noexcept { return level_; }
  [[nodiscard]] double debt() const noexcept { return level_ < 0 ? -level_ : 0.0; }
  /// What is borrowed and not paid back [J].
  [[nodiscard]] double owed() const noexcept { return owed_; }
  /// What is in no spring [J], after the last hold().
  [[nodiscard]] double free() const noexcept { return level_ - booked_; }
  [[nodiscard]] double damping() const noexcept { return damping_; }

 private:
  [[nodiscard]] SplitBound bound_of(const PortLoad& load, double dt) const noexcept;

  double damping_;
  double limit_;
  double level_ = 0.0;
  double booked_ = 0.0;  // w S of the last hold
  double owed_ = 0.0;
  double unseen_ = kUnseen;
  Eigen::Vector3d held_ = Eigen::Vector3d::Zero();
};

}  // namespace reckon::haptics
