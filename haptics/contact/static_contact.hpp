// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The walls of a device: scales the contact solver's force so that the sampled wall stays passive
// for this device, and books what its springs store.
#pragma once

#include <Eigen/Core>

#include "reckon/haptics/contact/contact_solver.hpp"
#include "reckon/haptics/passivity/energy_port.hpp"

namespace reckon::haptics {

/// Contact with all static objects as one storage S = gain * sum 1/2 k |x - scp|^2, booked whole.
///
/// The gain is at most what brings the stiffest of the touched objects under the cap. Where it is
/// less it rises in 100 ms as the port pays; once nothing is touched it is full again. Where the
/// device starts inside an object, or the force was cut to nothing while it was pressed, it begins
/// at zero and fades in over half a second, with energy that is lent: lacks() says how much. Where
/// a contact goes over a border between patches its springs follow as PatchBlend says, paid by the
/// port. Calls within a step: settle, load, shown, attenuate.
class StaticContact {
 public:
  /// @param plan outlives this.  @param stiffness_cap [N/m] of any object
  /// @param radius of the probe [m], >= 0
  StaticContact(const EffectPlan& plan, double stiffness_cap, double radius = 0.0);

  /// Starts anew at `device` [m, S].
  void reset(const Eigen::Vector3d& device) noexcept;

  /// Moves the contact to `device` [m] after a sample of `dt` [s], and books what it stored or
  /// released.
  void settle(const Eigen::Vector3d& device, double dt, EnergyPort& port) noexcept;

  /// Adds what is to be held: springs, and the effects' forces, which never pull.
  /// @param velocity of the device [m/s]  @param dt [s], of the next sample
  void load(const Eigen::Vector3d& velocity, double dt, PortLoad& load) noexcept;

  /// The force was cut to nothing: what is touched fades in again.
  void drop() noexcept { fades_in_ = fades_in_ || result_.stored_energy > 0; }
  /// What the walls lack of what they should store, where it is lent [J]; else 0.
  [[nodiscard]] double lacks() const noexcept {
    return fades_in_ ? (most_gain() - gain_) * result_.stored_energy : 0.0;
  }

  /// What was held of the effects' forces, [0, 1].
  void shown(double extra) noexcept { force_ = gain_ * result_.force + extra * extra_; }

  /// Scales force and storage by `factor` in [0, 1].
  void attenuate(double factor, EnergyPort& port) noexcept;

  [[nodiscard]] const ContactResult& result() const noexcept { return result_; }
  [[nodiscard]] const Eigen::Vector3d& force() const noexcept { return force_; }
  [[nodiscard]] double gain() const noexcept { return gain_; }
  /// Of the springs, what is shown for lack of energy, [0, 1]; 1 where it is not short.
  [[nodiscard]] double share() const noexcept { return share_; }
  /// Force of the springs as stiff as the device can show them [N].
  [[nodiscard]] double asked() const noexcept {
    return most_gain() / patch_share_ * result_.force.norm();
  }
  /// Of the springs [N], what the gain lacks of what the cap allows.
  [[nodiscard]] Eigen::Vector3d held_back() const noexcept {
    return (most_gain() - gain_) * result_.force;
  }
  [[nodiscard]] double stored() const noexcept { return gain_ * result_.stored_energy; }

 private:
  [[nodiscard]] double most_gain() const noexcept;
  void scale_gain(double factor, EnergyPort& port) noexcept;
  void follow_patches(double dt, EnergyPort& port) noexcept;
  void raise_gain(double dt, EnergyPort& port) noexcept;
  void measure_stiffness() noexcept;

  ContactSolver solver_;
  double cap_;
  ContactResult result_;
  Eigen::Vector3d at_ = Eigen::Vector3d::Zero();  // [m], the device
  double stiffness_ = 0.0;                        // [N/m], of the stiffest object touched
  double gain_ = 1.0;
  double share_ = 1.0;
  double patch_share_ = 1.0;  // of it, where patches are not paid for
  bool fades_in_ = false;     // until the gain is whole or the contact is left
  Eigen::Vector3d extra_ = Eigen::Vector3d::Zero();  // [N], what the effects want
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero();
};

}  // namespace reckon::haptics
