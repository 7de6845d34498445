// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The receiver-side gate of one contact: whatever parameters arrive, in whatever order, the hand
// never gets more energy out of the contact than went in. Proof: docs/haptic_stability.md.
#pragma once

#include <Eigen/Core>

#include "reckon/haptics/passivity/contact_potential.hpp"
#include "reckon/haptics/passivity/energy_ledger.hpp"

namespace reckon::haptics {

/// A potential S(x; theta), a friction bristle, and the ledger that pays for every change of theta.
///
/// Order of calls within a servo step: settle, then any of credit, move, give; then render; then
/// attenuate if the sum of forces must shrink. The force of render() is taken to be held on the
/// device until the next settle(). Invariant at the end of each step: S + ledger - all credits +
/// all gifts <= energy absorbed at the port + damping share. All of it O(1), no allocation; the
/// only costly step is one where the ledger blocks (40 halvings).
class ForceGate {
 public:
  /// @param ledger_limit [J], see EnergyLedger.
  explicit ForceGate(double ledger_limit = 0.02) noexcept : ledger_(ledger_limit) {}

  /// Forgets the contact, ledger included, at this probe position [m]. Always allowed.
  void reset(const Eigen::Vector3d& probe) noexcept;

  /// Forgets the contact and keeps the ledger and what the spring held: a teleport of the surface.
  void release() noexcept;

  /// Books the sample that ended: the hand moved from the last probe position to `probe` under the
  /// held force. @param damping_share [N s/m], this contact's part of the device's sure damping
  /// @param dt [s] > 0, true length of the sample
  void settle(const Eigen::Vector3d& probe, double damping_share, double dt) noexcept;

  /// Moves theta towards `target` as far as the ledger pays. A change of kind, or a step where
  /// neither end touches the probe, is a jump (the former through gain 0).
  /// @return fraction of the way made, 0..1.
  double move(const ContactParameters& target) noexcept;

  /// Energy [J] by which the ledger falls short of jumping to `target` at once; 0 = nothing.
  [[nodiscard]] double shortfall(const ContactParameters& target) const noexcept;

  /// Force on the hand [N] to hold until the next settle: spring, bristle and `damper`, which is
  /// cut so that it costs at most what the ledger holds and the normal part never pulls.
  /// @param damper [N], along the normal  @param damping_share, dt as expected for the next sample
  [[nodiscard]] const Eigen::Vector3d& render(double damper, double damping_share,
                                              double dt) noexcept;

  /// Scales force and storage by `factor` in [0, 1] after render(): saturation and trips.
  void attenuate(double factor) noexcept;

  /// The device dropped the force of render() by itself: the next settle() books no work.
  void let_go() noexcept { force_.setZero(); }

  /// Adds energy that was given to us. @return what fitted [J].
  double credit(double energy) noexcept;
  /// Gives away min(0.9 ledger, wanted). @return what was given [J].
  double give(double wanted) noexcept;

  [[nodiscard]] const ContactParameters& parameters() const noexcept { return theta_; }
  [[nodiscard]] const Eigen::Vector3d& force() const noexcept { return force_; }
  [[nodiscard]] const ContactGeometry& geometry() const noexcept { return state_.geometry; }
  [[nodiscard]] double stored() const noexcept { return state_.energy; }
  /// Probe position of the last settle [m].
  [[nodiscard]] const Eigen::Vector3d& probe() const noexcept { return probe_; }
  [[nodiscard]] double ledger() const noexcept { return ledger_.level(); }
  [[nodiscard]] bool slipping() const noexcept { return state_.slipping; }

 private:
  // Everything that follows from theta, the probe and the bristle.
  struct State {
    ContactGeometry geometry;
    double normal_force = 0.0;
    double energy = 0.0;
    Eigen::Vector3d bristle = Eigen::Vector3d::Zero();
    bool slipping = false;
  };
  [[nodiscard]] State evaluate(const ContactParameters& theta, const Eigen::Vector3d& bristle,
                               bool slipping) const noexcept;
  [[nodiscard]] State moved(const ContactParameters& theta) const noexcept;
  void settle_debt() noexcept;

  EnergyLedger ledger_;
  ContactParameters theta_;
  State state_;
  Eigen::Vector3d probe_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero();
};

}  // namespace reckon::haptics
