// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The one ledger of a haptic device: what the hand put in, what others gave, and the force that may
// be held with it. Whatever the contacts show, in whatever order, the hand never gets more energy
// out of the device than is in here. Proof: docs/haptic_stability.md.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <limits>

#include "reckon/haptics/passivity/held_forces.hpp"
#include "reckon/haptics/passivity/split.hpp"
#include "reckon/haptics/passivity/sure_damping.hpp"

namespace reckon::haptics {

/// What the contacts of a device want to be held for the next sample.
struct PortLoad {
  /// Springs of the static scene [N]; what they store is out of the ledger already, see book().
  Eigen::Vector3d walls = Eigen::Vector3d::Zero();
  double walls_slope = 0.0;   ///< [N/m], upper bound of their curvature
  double walls_stored = 0.0;  ///< [J]
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
  double walls = 1.0;                               ///< share of the walls: the caller books it
  double springs = 1.0;                             ///< share of the springs that is shown
  double extra = 1.0;                               ///< share of the extra force
};

/// Energy of one device. Order of calls within a servo step: settle (or miss), then any of book,
/// follow, credit, give and borrow, then hold, then attenuate if the force must shrink. What was
/// chosen last is taken to be written then, and to be at the handle `delay` samples later.
///
/// Springs that others move are paid from one level E that holds their storage too: it changes by
/// the work of the hand and the device's damping alone, wherever their surfaces go. hold() chooses
/// what E can answer for over any motion, together with all forces that are under way to the
/// handle. O(delay), allocates at construction alone.
class EnergyPort {
 public:
  /// Believed without being seen [J], and how fast that comes again [W]. Higher hinders honest play
  /// less where the shown surface lags behind what its owner does, and lets a liar do more.
  static constexpr double kUnseen = 0.005;
  static constexpr double kUnseenPower = 0.05;

  /// What all others together may put in at once [J], beyond received_power() over time: what waits
  /// in E beside what the springs store, and what may be credited at once. Higher lets a quick blow
  /// arrive whole, and a liar throw a hand that much harder.
  static constexpr double kReceivedAtOnce = 0.008;
  /// Most that is kept beside what the springs store [J], of it at most kReceivedAtOnce that the
  /// hand did not put in by its work. Higher lets more come back at once after a rest (stronger
  /// kicks), lower makes moving surfaces softer.
  static constexpr double kMostKept = 0.04;

  /// @param damping [N s/m] >= 0, the device's sure damping  @param delay [samples] >= 0, from a
  /// write to the force at the handle  @param resolution [m] >= 0, the device's encoder step
  explicit EnergyPort(double damping, int delay = 0, double resolution = 0.0)
      : damping_(damping, resolution),
        held_(delay),
        samples_(1.0 + delay),
        unsure_(kHalfDiagonal * resolution) {}

  /// Most that all others together put in, less what was given to them [W] > 0; at first endless.
  /// What comes in beyond it is not lost, it waits: see receivable().
  void limit_received_power(double power) noexcept { received_power_ = power; }

  /// Books the sample that ended: the hand moved by dx [m] in dt [s] > 0, and whatever samples were
  /// missed before it. Of those nobody knows when the hand went how far under which force: the
  /// worst is booked, and nothing that the hand may have put in.
  void settle(const Eigen::Vector3d& dx, double dt) noexcept;
  /// A sample of dt [s] > 0 ended and where the hand is was not read.
  void miss(double dt) noexcept;
  /// Books what a wall took in storage (negative) or gave back (positive) [J].
  void book(double energy) noexcept { level_ += energy; }
  /// Whether the handle is read in steps; follow() does nothing where it is not.
  [[nodiscard]] bool reads_in_steps() const noexcept { return unsure_ > 0; }
  /// A spring's force changed by `change` [N] as the hand was read to move by dx [m]. Where an
  /// encoder went one step on, the hand crossed it between both forces, not under the first alone.
  void follow(const Eigen::Vector3d& change, const Eigen::Vector3d& dx) noexcept;
  /// Adds energy that was given to us. @return what there was room for [J].
  double credit(double energy) noexcept;
  /// Adds energy that somebody only says to have given us. Who stands still has nothing to give but
  /// what was given to him: the hand behind a surface that brings energy is seen to push. So it is
  /// believed as far as it was seen, and 5 mJ beyond that, which come again at 50 mW: one such
  /// account for all, whatever they call themselves. The rest is lost. @param seen [J] >= 0
  double credit(double energy, double seen) noexcept;
  /// How much may be credited now [J], whoever gives it: so much in all, and more with time, as far
  /// as there is room.
  [[nodiscard]] double receivable() const noexcept;
  /// Time passes [s]: both accounts fill again.
  void wait(double dt) noexcept;
  /// Takes `wanted` [J] to give it away, at most 0.9 E, and leaves what answers for the forces
  /// under way. @return what was taken [J].
  double give(double wanted) noexcept;
  /// Adds energy that nobody put in, to be paid back; the caller bounds it. @param energy [J] >= 0
  void borrow(double energy) noexcept;
  /// Pays back, at most what is owed, and leaves what answers for the forces under way.
  /// @param energy [J] >= 0
  void pay_back(double energy) noexcept;

  /// Chooses what to hold for the next dt [s], and throws away what the limit does not let keep.
  PortHold hold(const PortLoad& load, double dt) noexcept;
  /// Holds `force` [N] in place of what hold() chose for the same load: one that lags behind it is
  /// a rest like any other. @return false, and nothing changes, where E cannot answer for it.
  bool hold_instead(const PortLoad& load, const Eigen::Vector3d& force, double dt) noexcept;
  /// The force is scaled by `factor` in [0, 1] on its way to the device.
  void attenuate(double factor) noexcept { chosen_ *= factor; }
  /// The device dropped the force by itself, and all that were under way.
  void let_go() noexcept;
  /// Forgets all energy: what the hand took since is not known. What is owed stays owed.
  void clear() noexcept;

  /// E [J]; below 0 only after a sample that was late or a wall that cost more than was there.
  [[nodiscard]] double level() const noexcept { return level_; }
  [[nodiscard]] double debt() const noexcept { return level_ < 0 ? -level_ : 0.0; }
  /// What is borrowed and not paid back [J].
  [[nodiscard]] double owed() const noexcept { return owed_; }
  /// What is in no spring [J], after the last hold().
  [[nodiscard]] double free() const noexcept { return level_ - booked_; }
  [[nodiscard]] double damping() const noexcept { return damping_.damping(); }
  /// What the hand put in and the device's damping surely took [J], since the start.
  [[nodiscard]] double absorbed() const noexcept { return absorbed_; }
  /// Most that absorbed() may be above the truth, for an encoder tells only so much [J]: half the
  /// diagonal of its step for each newton by which forces changed, to and fro. 0 without steps.
  [[nodiscard]] double encoder_allowance() const noexcept {
    return reads_in_steps() ? allowance_ + unsure_ * held_.at_handle().norm() : 0.0;
  }
  /// What pays for a force that stands still until it has left the handle again: |F|^2 / (4 spare)
  /// [N/m]. @param walls_slope [N/m], of the walls touched  @param dt [s], of a sample
  [[nodiscard]] double spare(double walls_slope, double dt) const noexcept {
    return (damping() / dt - 0.5 * samples_ * walls_slope) / samples_;
  }

 private:
  static constexpr double kHalfDiagonal = 0.8660254037844386;  // of a cube of side 1

  [[nodiscard]] SplitBound bound_of(const PortLoad& load, double walls, double dt) const noexcept;
  [[nodiscard]] bool choose_part(const PortLoad& load, const SplitBound& bound,
                                 PortHold& out) const noexcept;
  void lower_walls(const PortLoad& load, double dt, PortHold& out) const noexcept;
  void pass() noexcept;
  void keep_in_mind(double dt) noexcept;
  void settle_missed(const Eigen::Vector3d& dx) noexcept;
  void absorb(double energy) noexcept {
    level_ += energy;
    absorbed_ += energy;
  }
  void take_back(double energy) noexcept {
    const double back = std::clamp(energy, 0.0, pushed_);
    unearned_ += back;
    pushed_ -= back;
  }
  [[nodiscard]] double spendable() const noexcept;
  [[nodiscard]] double waiting() const noexcept;

  SureDamping damping_;
  HeldForces held_;
  double samples_;  // for which a force that is chosen is answered for
  double unsure_;   // [m], by which a reading may be off
  double level_ = 0.0;
  double booked_ = 0.0;  // w S of the last hold
  double period_ = 0.0;  // [s], of the last hold
  double owed_ = 0.0;
  double unearned_ = 0.0;  // of E, what others gave
  double pushed_ = 0.0;    // of that, what left E, as into the hand, and did not come back
  double unseen_ = kUnseen;
  double received_power_ = std::numeric_limits<double>::infinity();
  double receivable_ = kReceivedAtOnce;
  double absorbed_ = 0.0;
  double allowance_ = 0.0;
  Eigen::Vector3d chosen_ = Eigen::Vector3d::Zero();  // to be written
  // Where samples were missed, since the last reading: time, and force and its square over time.
  double time_ = 0.0;
  Eigen::Vector3d impulse_ = Eigen::Vector3d::Zero();
  double squares_ = 0.0;
  bool missed_ = false;
  int doubtful_ = 0;  // samples in which the device may not hold what was written
};

}  // namespace reckon::haptics
