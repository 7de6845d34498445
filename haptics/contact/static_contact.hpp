// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The energy books of the static scene: scales the contact solver's force so that the sampled wall
// stays passive for this device.
#pragma once

#include <Eigen/Core>

#include "reckon/haptics/contact/contact_solver.hpp"
#include "reckon/haptics/passivity/energy_ledger.hpp"

namespace reckon::haptics {

/// Contact with all static objects as one storage S = gain * sum 1/2 k |x - scp|^2 and one ledger.
///
/// The gain is at most what brings the stiffness of all touched objects under the cap. It is held
/// at zero where the device starts inside an object and rises again in 100 ms as the ledger pays;
/// once nothing is touched it is full again. Calls within a step: settle, render, attenuate.
class StaticContact {
 public:
  /// @param plan outlives this.  @param stiffness_cap [N/m] for all objects together
  /// @param ledger_limit [J]
  StaticContact(const EffectPlan& plan, double stiffness_cap, double ledger_limit = 0.02);

  /// Starts anew at `device` [m, S].
  void reset(const Eigen::Vector3d& device) noexcept;

  /// Moves the contact to `device` and books the sample that ended. Units as in ForceGate::settle.
  void settle(const Eigen::Vector3d& device, double damping_share, double dt) noexcept;

  /// Force to hold until the next settle [N, S]: springs, and the effects' forces as far as the
  /// ledger covers them.
  [[nodiscard]] const Eigen::Vector3d& render(const Eigen::Vector3d& velocity, double damping_share,
                                              double dt) noexcept;

  /// Scales force and storage by `factor` in [0, 1] after render().
  void attenuate(double factor) noexcept;

  /// The device dropped the force by itself: the next settle() books no work.
  void let_go() noexcept { force_.setZero(); }

  [[nodiscard]] const ContactResult& result() const noexcept { return result_; }
  [[nodiscard]] const Eigen::Vector3d& force() const noexcept { return force_; }
  [[nodiscard]] double gain() const noexcept { return gain_; }
  [[nodiscard]] double stored() const noexcept { return gain_ * result_.stored_energy; }
  [[nodiscard]] double ledger() const noexcept { return ledger_.level(); }

 private:
  void scale_gain(double factor) noexcept;
  void raise_gain(double dt) noexcept;
  void measure_stiffness() noexcept;

  const EffectPlan& plan_;
  ContactSolver solver_;
  double cap_;
  EnergyLedger ledger_;
  ContactResult result_;
  double stiffness_ = 0.0;  // [N/m], of the objects touched
  double gain_ = 1.0;
  Eigen::Vector3d device_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero();
};

}  // namespace reckon::haptics
