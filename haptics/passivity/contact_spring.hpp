// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The spring and the friction bristle of one contact with a surface that others move: a potential
// paid from the port's energy. Frame S, SI units.
#pragma once

#include <Eigen/Core>

#include "reckon/haptics/passivity/contact_potential.hpp"

namespace reckon::haptics {

/// S(x; theta) at the last position of the probe, with a bristle in the tangent plane that sticks
/// and slides. It keeps no energy account: EnergyPort does, for all contacts of a device. Every
/// call is O(1).
class ContactSpring {
 public:
  /// Discards the contact, at this probe position [m].
  void reset(const Eigen::Vector3d& probe) noexcept;

  /// Releases the surface: gain 0. The next surface starts a new contact.
  void release() noexcept;

  /// The probe moved, and spring and bristle follow. @param probe [m]  @param dt [s], duration of
  /// the move
  void settle(const Eigen::Vector3d& probe, double dt) noexcept;

  /// Moves the surface to these parameters, with the foot of the bristle. A change of kind begins
  /// with gain 0. Ignored if is_usable() is false.
  void move(const ContactParameters& target) noexcept;

  /// Force on the probe [N]: spring and bristle.
  [[nodiscard]] const Eigen::Vector3d& force() const noexcept { return contact_.force; }
  /// Stored energy S [J] >= 0.
  [[nodiscard]] double stored() const noexcept { return contact_.energy; }
  /// Upper bound H of the curvature of S over any motion [N/m]: S(x + dx) <= S(x) - F.dx + dx.H dx
  /// / 2. Zero if nothing is stored, because nothing is booked then.
  [[nodiscard]] Eigen::Matrix3d slope() const noexcept;
  /// Its greatest eigenvalue [N/m].
  [[nodiscard]] double greatest_slope() const noexcept;

  [[nodiscard]] const ContactParameters& parameters() const noexcept { return theta_; }
  [[nodiscard]] const ContactGeometry& geometry() const noexcept { return contact_.geometry; }
  /// Force of the spring along the normal [N].
  [[nodiscard]] double normal_force() const noexcept { return contact_.normal_force; }
  [[nodiscard]] const Eigen::Vector3d& probe() const noexcept { return probe_; }
  [[nodiscard]] bool slipping() const noexcept { return contact_.slipping; }

 private:
  // Results from theta, the probe and the bristle.
  struct ContactState {
    ContactGeometry geometry;
    double normal_force = 0.0;
    Eigen::Vector3d force = Eigen::Vector3d::Zero();  // including the bristle
    double energy = 0.0;
    Eigen::Vector3d bristle = Eigen::Vector3d::Zero();
    bool slipping = false;
  };
  // @param fall [N], greatest decrease of the pull of a slipping bristle
  [[nodiscard]] ContactState evaluate(const ContactParameters& theta,
                                      const Eigen::Vector3d& bristle, bool slipping,
                                      double fall) const noexcept;
  [[nodiscard]] double pull() const noexcept;  // of the bristle [N]

  ContactParameters theta_;
  ContactState contact_;
  Eigen::Vector3d probe_ = Eigen::Vector3d::Zero();
};

}  // namespace reckon::haptics
