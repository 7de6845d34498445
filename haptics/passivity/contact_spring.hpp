// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The spring and the friction bristle of one contact with what others move: a potential that the
// port's energy pays for. Frame S, SI units.
#pragma once

#include <Eigen/Core>

#include "reckon/haptics/passivity/contact_potential.hpp"

namespace reckon::haptics {

/// S(x; theta) at the last place of the probe, with a bristle in the tangent plane that sticks and
/// slides. Keeps no energy: EnergyPort does, for all contacts of a device. All of it O(1).
class ContactSpring {
 public:
  /// Forgets the contact, at this probe position [m].
  void reset(const Eigen::Vector3d& probe) noexcept;

  /// Lets go of the surface: gain 0. What it shows next begins anew.
  void release() noexcept;

  /// The probe moved: springs and bristle follow. @param probe [m]  @param dt [s], that it took
  void settle(const Eigen::Vector3d& probe, double dt) noexcept;

  /// Shows the surface with these parameters. The bristle's foot goes with it; a change of kind
  /// begins with gain 0. Ignored where is_usable() says no.
  void move(const ContactParameters& target) noexcept;

  /// On the probe [N]: spring and bristle.
  [[nodiscard]] const Eigen::Vector3d& force() const noexcept { return contact_.force; }
  /// S [J] >= 0.
  [[nodiscard]] double stored() const noexcept { return contact_.energy; }
  /// Upper bound H of the curvature of S over any motion [N/m]: S(x + dx) <= S(x) - F.dx +
  /// dx.H dx / 2. Zero where nothing is stored: nothing is booked there.
  [[nodiscard]] Eigen::Matrix3d slope() const noexcept;
  /// Its greatest eigenvalue [N/m].
  [[nodiscard]] double greatest_slope() const noexcept;

  [[nodiscard]] const ContactParameters& parameters() const noexcept { return theta_; }
  [[nodiscard]] const ContactGeometry& geometry() const noexcept { return contact_.geometry; }
  /// Of the spring along the normal alone [N].
  [[nodiscard]] double normal_force() const noexcept { return contact_.normal_force; }
  [[nodiscard]] const Eigen::Vector3d& probe() const noexcept { return probe_; }
  [[nodiscard]] bool slipping() const noexcept { return contact_.slipping; }

 private:
  // Everything that follows from theta, the probe and the bristle.
  struct ContactState {
    ContactGeometry geometry;
    double normal_force = 0.0;
    Eigen::Vector3d force = Eigen::Vector3d::Zero();  // with the bristle's
    double energy = 0.0;
    Eigen::Vector3d bristle = Eigen::Vector3d::Zero();
    bool slipping = false;
  };
  // @param fall [N], most by which a bristle that slips may pull less than it does now
  [[nodiscard]] ContactState evaluate(const ContactParameters& theta,
                                      const Eigen::Vector3d& bristle, bool slipping,
                                      double fall) const noexcept;
  [[nodiscard]] double pull() const noexcept;  // of the bristle [N]

  ContactParameters theta_;
  ContactState contact_;
  Eigen::Vector3d probe_ = Eigen::Vector3d::Zero();
};

}  // namespace reckon::haptics
