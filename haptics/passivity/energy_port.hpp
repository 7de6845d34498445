// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The ledger of one haptic device: the energy that the hand put in, the energy that others gave,
// and the force that may be held with it. For any contacts and any order of calls, the hand never
// gets more energy out of the device than the ledger has. Proof: docs/haptic_stability.md.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "reckon/haptics/passivity/energy_ledger.hpp"
#include "reckon/haptics/passivity/held_forces.hpp"
#include "reckon/haptics/passivity/split.hpp"
#include "reckon/haptics/passivity/sure_damping.hpp"

namespace reckon::haptics {

/// Forces that the contacts of a device request for the next sample. `axes` [N], and [N m] where an
/// axis turns; see DampedAxes.
template <int axes>
struct PortLoadOf {
  using Force = AxisForces<axes>;

  /// Springs of the static scene [N]; their storage is already booked, see book().
  Force walls = Force::Zero();
  double walls_slope = 0.0;   ///< [N/m], upper bound of their curvature
  double walls_stored = 0.0;  ///< [J]
  /// Sum of the springs that others move [N]. Opposite forces cancel and cost nothing.
  Force springs = Force::Zero();
  double stored = 0.0;         ///< [J], sum of their storage
  double springs_slope = 0.0;  ///< [N/m], greatest eigenvalue of the sum of their curvature bounds
  /// Forces without storage: dampers, effects [N].
  Force extra = Force::Zero();
  /// Oscillations of regions, paid for by OscillationBucket [N].
  Force shake = Force::Zero();
};

/// The part of the load that can be held.
template <int axes>
struct PortHoldOf {
  using Force = AxisForces<axes>;

  Force force = Force::Zero();  ///< [N]
  double weight = 0.0;          ///< share of `stored` that is booked
  double walls = 1.0;           ///< share of the walls; the caller books it
  double springs = 1.0;         ///< rendered share of the springs
  double extra = 1.0;           ///< share of the extra force
};

/// Energy of one device. Order of calls within a servo step: settle (or miss), then any of book,
/// follow, credit, give and borrow, then hold, then attenuate if the force must be reduced. The
/// force of the last hold() counts as written then, and reaches the handle `delay` samples later.
///
/// Springs that others move are paid from one level E, which includes their storage. E changes only
/// by the work of the hand and the device's damping, wherever the surfaces move. hold() chooses a
/// force for which E can pay over any motion, together with all pending forces. O(delay); allocates
/// only at construction.
/// @tparam axes 3, or 6 for a device that turns
template <int axes>
class EnergyPortOf : public EnergyLedger {
 public:
  using Force = AxisForces<axes>;
  using Load = PortLoadOf<axes>;
  using Hold = PortHoldOf<axes>;

  /// @param damping [N s/m] >= 0, guaranteed damping of the device
  /// @param delay [samples] >= 0, from a write to the force at the handle
  /// @param resolution [m] >= 0, the device's encoder step
  explicit EnergyPortOf(double damping, int delay = 0, double resolution = 0.0)
      : sure_(damping, resolution),
        held_(delay),
        shaken_(delay),
        samples_(1.0 + delay),
        dampings_(static_cast<std::size_t>(delay) + 2, damping),
        damping_(damping),
        here_(half_diagonal(resolution)),
        unsure_(here_) {}

  /// Sets the device's damping [N s/m] >= 0 and encoder step [m] >= 0 at the pose of the next
  /// settle(), until the next call. A force is paid for with the least damping in force when it, or
  /// another pending force, was chosen.
  void pose(double damping, double resolution) noexcept;

  /// Books the last sample, in which the hand moved by dx [m] in dt [s] > 0, and the missed samples
  /// before it. For missed samples the motion under each force is unknown. So the worst case is
  /// booked, and no work of the hand is credited.
  void settle(const Force& dx, double dt) noexcept { settle(dx, dt, dt); }
  /// @param took [s] >= 0, duration of the motion dx, if the device reports it; 0: no motion
  /// @param held [0, 1], least share of the force that was at the handle: energy from the hand is
  /// booked with this share, energy to the hand in full
  void settle(const Force& dx, double dt, double took, double held = 1.0) noexcept;
  /// Books a sample of dt [s] > 0 without a reading of the handle.
  void miss(double dt) noexcept;
  /// Whether the handle is read in encoder steps; otherwise follow() does nothing.
  [[nodiscard]] bool reads_in_steps() const noexcept { return unsure_ > 0; }
  /// Books a change of a spring's force by `change` [N] while the reading moved by dx [m]. The hand
  /// crossed an encoder step somewhere between both forces, not under the first one alone.
  void follow(const Force& change, const Force& dx) noexcept;

  /// Chooses the force to hold for the next dt [s], and discards energy above the limits.
  Hold hold(const Load& load, double dt) noexcept;
  /// Holds `force` [N] instead of the one that hold() chose for the same load. A force that lags
  /// behind is paid for like any held force. @return false, without any change, if E cannot pay for
  /// it.
  bool hold_instead(const Load& load, const Force& force, double dt) noexcept;
  /// Chooses the part of load.shake to hold in addition, after hold(); see OscillationBucket.
  const Force& shake(const Load& load, double dt) noexcept;
  /// Whether an oscillation is held or pending.
  [[nodiscard]] bool shakes() const noexcept { return shakes_for_ > 0; }
  /// Greatest energy that pending oscillations may put in [J].
  [[nodiscard]] double shakes_under_way(double dt) const noexcept {
    if (shakes_for_ == 0 || !(damping() > 0)) return 0.0;
    const double squares = shaken_.under_way(Force::Zero()).squares;
    return std::min(oscillations().level(), squares * dt / (4.0 * kShakeShare * damping()));
  }
  /// Held part of the oscillations, after attenuate() [N].
  [[nodiscard]] const Force& shaking() const noexcept { return shaking_; }
  /// Scales the chosen force by `factor` in [0, 1] before it is written.
  void attenuate(double factor) noexcept {
    chosen_ *= factor;
    shaking_ *= factor;
  }
  /// The device dropped its force and all pending forces by itself.
  void drop_force() noexcept;
  /// Discards all energy, because the hand may have taken it; absorbed() falls by it. The debt
  /// stays.
  void clear() noexcept;

  [[nodiscard]] double damping() const noexcept { return damping_; }
  /// Force held in the last sample.
  [[nodiscard]] Force at_handle() const noexcept { return held_.at_handle() + shaken_.at_handle(); }
  /// Greatest part of a negative E due to samples longer than the dt of their hold(), since the
  /// start [J]. Each may take b |dx|^2 (1 / dt - 1 / its length) more than was assumed. 0 for a
  /// punctual servo.
  [[nodiscard]] double late_cost() const noexcept { return late_cost_; }
  /// Greatest error of absorbed() above the truth from encoder steps [J]: half the diagonal of a
  /// step for each newton by which forces changed, in either direction. 0 without steps.
  [[nodiscard]] double encoder_allowance() const noexcept {
    return reads_in_steps() ? allowance_ + unsure_ * at_handle().norm() : 0.0;
  }
  /// [N/m]: |F|^2 / (4 spare) is the energy that pays for a constant force until it has left the
  /// handle. @param walls_slope [N/m], of touched walls  @param dt [s], of a sample
  [[nodiscard]] double spare(double walls_slope, double dt) const noexcept {
    return (damping() / dt - 0.5 * samples_ * walls_slope) / samples_;
  }

 private:
  /// Share of the damping that pays for an oscillation's worst motion while there is one.
  static constexpr double kShakeShare = 0.1;

  [[nodiscard]] SplitBoundOf<axes> bound_of(const Load& load, double walls,
                                            double dt) const noexcept;
  [[nodiscard]] bool choose_part(const Load& load, const SplitBoundOf<axes>& bound,
                                 Hold& out) const noexcept;
  void lower_walls(const Load& load, double dt, Hold& out) const noexcept;
  void pass() noexcept;
  void note_late(const Force& dx, double dt) noexcept;
  void keep_in_mind(double dt) noexcept;
  void settle_missed(const Force& dx, double took, double held) noexcept;
  [[nodiscard]] static double half_diagonal(double resolution) noexcept {
    return 0.5 * std::sqrt(axes) * resolution;
  }
  void commit() noexcept;
  void settle_shake(const Force& dx, double held) noexcept;
  /// Share of the damping that pays for all other forces.
  [[nodiscard]] double rest_share() const noexcept {
    return shakes_for_ > 0 ? 1.0 - kShakeShare : 1.0;
  }

  SureDampingOf<axes> sure_;
  HeldForcesOf<axes> held_;       // without oscillations
  HeldForcesOf<axes> shaken_;     // oscillations
  double samples_;                // samples for which a chosen force has to be paid
  std::vector<double> dampings_;  // [N s/m], of the last delay + 2 poses, a ring buffer
  std::size_t next_damping_ = 0;
  double damping_;            // least of dampings_
  double here_;               // [m], greatest error of the last reading
  double unsure_;             // [m], error of the last two readings together
  double period_ = 0.0;       // [s], dt of the last hold()
  double late_ = 0.0;         // part of a negative E from late samples
  double written_off_ = 0.0;  // of late_, by clear()
  double late_cost_ = 0.0;
  double allowance_ = 0.0;
  Force chosen_ = Force::Zero();   // to be written
  Force shaking_ = Force::Zero();  // oscillation to be written
  int shakes_for_ = 0;             // samples for which an oscillation is held or pending
  // Since the last reading, if samples were missed: time, and integrals of force and its square.
  double time_ = 0.0;
  Force impulse_ = Force::Zero();
  double squares_ = 0.0;
  Force shake_impulse_ = Force::Zero();
  double shake_squares_ = 0.0;
  bool missed_ = false;
  int doubtful_ = 0;  // samples in which the device may not hold the written force
};

using PortLoad = PortLoadOf<3>;
using PortHold = PortHoldOf<3>;
using EnergyPort = EnergyPortOf<3>;

}  // namespace reckon::haptics
