// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The walls at one probe: scales the contact solver's force so that the sampled wall stays passive
// for this device, and books the storage of its springs.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "reckon/haptics/contact/contact_solver.hpp"
#include "reckon/haptics/passivity/energy_port.hpp"

namespace reckon::haptics {

/// Contact with all static objects as one storage S = gain * sum 1/2 k |x - scp|^2, booked whole.
///
/// The greatest gain brings the stiffest touched object under the cap. A lower gain rises to it in
/// 100 ms as the ledger pays. It is full again when nothing is touched. If the device starts inside
/// an object, or the force was cut to zero while it was pressed, the gain begins at zero and rises
/// within half a second on a loan; lacks() returns its amount. If a contact crosses a border
/// between patches, its springs follow as in PatchBlend, paid by the ledger. If the loan ends
/// before the gain is full, the springs get their full stiffness, and a part of their depth is
/// hidden instead: the force stays the same, and further pressing has the right stiffness. Order of
/// calls within a step: move, settle, load, shown, attenuate.
class WallContact {
 public:
  /// @param plan outlives this object  @param stiffness_cap [N/m] of any object
  /// @param radius of the probe [m], >= 0
  WallContact(const EffectPlan& plan, double stiffness_cap, double radius = 0.0);

  /// See ContactSolver.
  void let_through_beyond(double force) noexcept { solver_.let_through_beyond(force); }
  [[nodiscard]] std::uint32_t passed() const noexcept { return solver_.passed(); }
  /// Sets the state of a moving object, before move(); see ContactSolver.
  void place(std::uint32_t body, const ObjectMotion& motion, const ObjectMotion& before) noexcept {
    solver_.place(body, motion, before);
  }
  void set_carried(std::uint32_t body, bool is_carried) noexcept {
    solver_.set_carried(body, is_carried);
  }
  [[nodiscard]] bool is_carried(std::uint32_t index) const noexcept {
    return solver_.is_carried(index);
  }
  /// Restarts at `device` [m, S].
  void reset(const Eigen::Vector3d& device) noexcept;

  /// Goes on elsewhere with its whole force, as a probe that has moved from `from` to `device` [m,
  /// S]. The ledger pays for the storage.
  void resume(const Eigen::Vector3d& from, const Eigen::Vector3d& device,
              EnergyLedger& ledger) noexcept;

  /// Sets the stiffness limit of all objects [N/m] from the next settle() on, at most the initial
  /// cap.
  void limit(double stiffness) noexcept { cap_ = stiffness; }

  /// Moves the contact to `device` [m] after a sample of `dt` [s], and books the stored or released
  /// energy. @return the change of the springs' force [N]
  Eigen::Vector3d move(const Eigen::Vector3d& device, double dt, EnergyLedger& ledger) noexcept;
  /// Lowers the gain for a debt, and raises it as the ledger pays. @param dt [s] of that sample
  void settle(double dt, EnergyLedger& ledger) noexcept;

  /// Sets the predicted difference between the mean force of bodies' springs over the next sample
  /// and their present force [N]. For the next load().
  void foresee(const Eigen::Vector3d& change) noexcept { change_ = change; }

  /// Adds the forces to be held: springs, and the effects' forces, which never pull.
  /// @param velocity of the device [m/s]  @param dt [s], of the next sample
  void load(const Eigen::Vector3d& velocity, double dt, PortLoad& load) noexcept;

  /// The force was cut to zero: touched objects fade in again.
  void drop() noexcept {
    fades_in_ = fades_in_ || result_.stored_energy > 0;
    without_loan_ = 0.0;
  }
  /// Energy that the walls lack for their full storage while a loan is allowed [J]; else 0.
  [[nodiscard]] double lacks() const noexcept {
    return fades_in_ ? (most_gain() - gain_) * result_.stored_energy : 0.0;
  }

  /// Hidden depth of the touched objects [m], see above.
  [[nodiscard]] double hidden() const noexcept { return solver_.hidden(); }

  /// Takes the held share of the effects' forces, [0, 1].
  void shown(double extra) noexcept {
    shown_ = extra * not_pulling_;
    force_ = gain_ * result_.force + extra * extra_;
  }

  /// Scales force and storage by `factor` in [0, 1].
  void attenuate(double factor, EnergyLedger& ledger) noexcept;

  [[nodiscard]] const ContactResult& result() const noexcept { return result_; }
  /// Stiffness of an object's springs, touched or not [N/m].
  [[nodiscard]] double stiffness_of(std::uint32_t index) const noexcept {
    return std::min(gain_ * solver_.stiffness_of(index), cap_);
  }
  /// See ContactSolver.
  [[nodiscard]] std::optional<NearBody> near_body(std::size_t& next,
                                                  const Eigen::Vector3d& velocity,
                                                  double time) const noexcept {
    return solver_.near_body(next, velocity, time);
  }
  [[nodiscard]] double friction_of(std::uint32_t index) const noexcept {
    return solver_.friction_of(index);
  }
  /// Force of a touched object's effects [N, S], after shown(). The deepest object has them all.
  [[nodiscard]] Eigen::Vector3d effects_of(std::uint32_t index) const noexcept {
    return index == result_.deepest ? Eigen::Vector3d(shown_ * effects_) : Eigen::Vector3d::Zero();
  }
  /// Force of the walls [N, S], after shown().
  [[nodiscard]] const Eigen::Vector3d& force() const noexcept { return force_; }
  [[nodiscard]] double gain() const noexcept { return gain_; }
  /// Share of the springs that the available energy allows, [0, 1]; 1 if energy is not short.
  [[nodiscard]] double share() const noexcept { return share_; }
  /// Force of the springs at the greatest stiffness that the device can render [N].
  [[nodiscard]] double asked() const noexcept {
    return shown_depth_ > 0 ? most_gain() / patch_share_ / shown_depth_ * result_.force.norm()
                            : 0.0;
  }
  /// Force that the springs lack because the gain is below the cap [N].
  [[nodiscard]] Eigen::Vector3d held_back() const noexcept {
    return (most_gain() - gain_) * result_.force;
  }
  [[nodiscard]] double stored() const noexcept { return gain_ * result_.stored_energy; }
  /// Energy received from carried objects, as far as the port may receive it, minus the energy that
  /// they took, since the start [J].
  [[nodiscard]] double carried() const noexcept { return carried_; }

 private:
  [[nodiscard]] double most_gain() const noexcept;
  // Energy booked for the springs [J].
  [[nodiscard]] double booked() const noexcept { return gain_ * (result_.stored_energy - lent_); }
  void scale_gain(double factor, EnergyLedger& ledger) noexcept;
  void lend_for_motion(EnergyLedger& ledger) noexcept;
  void take_from_carried(EnergyLedger& ledger) noexcept;
  void follow_patches(double dt, EnergyLedger& ledger) noexcept;
  void raise_gain(double dt, EnergyLedger& ledger) noexcept;
  void hide_rest(double dt, EnergyLedger& ledger) noexcept;
  void measure_stiffness() noexcept;

  ContactSolver solver_;
  double cap_;
  ContactResult result_;
  double lent_ = 0.0;       // [J], at a gain of 1, see lend_for_motion()
  double stiffness_ = 0.0;  // [N/m], of the stiffest object touched
  double gain_ = 1.0;
  double share_ = 1.0;
  double patch_share_ = 1.0;  // share that the energy allows for patches
  double shown_depth_ = 1.0;  // least share of an object's depth that is not hidden
  double carried_ = 0.0;
  bool fades_in_ = false;                             // until the gain is full or the contact ends
  double without_loan_ = 0.0;                         // [s] since the loan ran out during a fade-in
  Eigen::Vector3d change_ = Eigen::Vector3d::Zero();  // [N], of the springs of bodies
  Eigen::Vector3d effects_ = Eigen::Vector3d::Zero();  // [N], wanted
  Eigen::Vector3d extra_ = Eigen::Vector3d::Zero();    // [N], effects_ + change_, without a pull
  double not_pulling_ = 1.0;  // share of effects_ + change_ that does not pull
  double shown_ = 1.0;        // held share of effects_ + change_
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero();
};

}  // namespace reckon::haptics
