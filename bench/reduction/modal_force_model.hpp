// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The reduced form of an elastic body: a few modes, and the rest as a static compliance. The form
// is passive by its signs alone and small enough to be sent. A hand only meets the displacement of
// its points, to which a contact spring of any stiffness is added.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <string>

#include "reckon/bench/linear_systems/state_space.hpp"

namespace reckon::bench {

/// Modes q_i'' + damping_i q_i' + omega_i^2 q_i = shape_i.f, displacement of the points
/// u = shape^T q + rest f, f the forces on them. Plain data, no heap.
struct ModalForceModel {
  static constexpr int kMostModes = 16;
  static constexpr int kMostPoints = 8;
  using PerMode = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostModes, 1>;

  PerMode omega;    ///< [rad/s], >= 0; 0: a rigid motion
  PerMode damping;  ///< 2 zeta omega [1/s], >= 0
  /// Displacement of each point by each mode, modes x points [kg^-1/2], any sign.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostModes, kMostPoints> shape;
  /// Static compliance outside the modes, points x points, symmetric, >= 0 [m/N].
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostPoints, kMostPoints> rest;

  [[nodiscard]] int modes() const noexcept { return static_cast<int>(omega.size()); }
  [[nodiscard]] int points() const noexcept { return static_cast<int>(rest.rows()); }
};

/// Damping ratio of a mode; 0 for a rigid motion.
[[nodiscard]] double damping_ratio(const ModalForceModel& model, int mode);

/// Reason why the model must not be used; empty if it may. Checks that sizes fit, all numbers are
/// finite, omega and damping >= 0, rest symmetric and >= 0. Then it is passive for any shapes.
[[nodiscard]] std::string refusal(const ModalForceModel& model);

/// Displacement per force at s = jw, points x points [m/N]; without modes only `rest`.
[[nodiscard]] Eigen::MatrixXcd compliance(const ModalForceModel& model, double angular_frequency);

/// Displacement per constant force [m/N]; not finite with rigid motions.
[[nodiscard]] Eigen::MatrixXd static_compliance(const ModalForceModel& model);

/// 1/2 sum(q'^2 + omega^2 q^2) + 1/2 f.rest f [J]: stored energy. It never grows by more than f.u'
/// dt. @param q [m kg^1/2], rate of it, one for each mode; f [N], one for each point
[[nodiscard]] double stored_energy(const ModalForceModel& model, const Eigen::VectorXd& q,
                                   const Eigen::VectorXd& rate, const Eigen::VectorXd& force);

/// From the force on the points to their displacement, 2 modes states (q, q'), continuous. For
/// devices that take motion (admittance).
[[nodiscard]] StateSpace displacement_of_force(const ModalForceModel& model);

/// From the displacement of probes to the forces that press them back, each on a contact spring
/// over its point, both in contact: f = (1/stiffness + compliance)^-1 x. For devices that take
/// force (impedance). @param stiffness of the contact [N/m], > 0, else std::invalid_argument
[[nodiscard]] StateSpace force_of_displacement(const ModalForceModel& model, double stiffness);

}  // namespace reckon::bench
