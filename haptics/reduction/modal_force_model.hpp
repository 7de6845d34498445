// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The reduced form of an elastic body: a few modes and what is left as a static compliance. The
// form is passive by its signs alone, small enough to be sent, and touches a hand only through the
// displacement of its points: a contact spring of any stiffness is put on top of it.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <string>

#include "reckon/haptics/analysis/state_space.hpp"

namespace reckon::haptics {

/// Modes q_i'' + damping_i q_i' + omega_i^2 q_i = shape_i.f, displacement of the points
/// u = shape^T q + rest f, f the forces on them. Plain data, no heap.
struct ModalForceModel {
  static constexpr int kMostModes = 16;
  static constexpr int kMostPoints = 8;
  using PerMode = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostModes, 1>;

  PerMode omega;    ///< [rad/s], >= 0; 0: a rigid motion
  PerMode damping;  ///< 2 zeta omega [1/s], >= 0
  /// How far each point moves with each mode, modes x points [kg^-1/2], any sign.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostModes, kMostPoints> shape;
  /// Static compliance of all that is not in the modes, points x points, symmetric, >= 0 [m/N].
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostPoints, kMostPoints> rest;

  [[nodiscard]] int modes() const noexcept { return static_cast<int>(omega.size()); }
  [[nodiscard]] int points() const noexcept { return static_cast<int>(rest.rows()); }
};

/// Damping ratio of a mode; 0 for a rigid motion.
[[nodiscard]] double damping_ratio(const ModalForceModel& model, int mode);

/// Why the model must not be used: empty where it may. Sizes fit, all numbers are finite, omega and
/// damping >= 0, rest symmetric and >= 0. Then it is passive, whatever the shapes.
[[nodiscard]] std::string refusal(const ModalForceModel& model);

/// Displacement a force at s = jw, points x points [m/N]; without modes rest alone.
[[nodiscard]] Eigen::MatrixXcd compliance(const ModalForceModel& model, double angular_frequency);

/// Displacement a lasting force [m/N]; not finite with rigid motions.
[[nodiscard]] Eigen::MatrixXd static_compliance(const ModalForceModel& model);

/// 1/2 sum(q'^2 + omega^2 q^2) + 1/2 f.rest f [J]: what the body holds. It never grows by more than
/// f.u' dt. @param q [m kg^1/2], rate of it, as many as modes; f [N], as many as points
[[nodiscard]] double stored_energy(const ModalForceModel& model, const Eigen::VectorXd& q,
                                   const Eigen::VectorXd& rate, const Eigen::VectorXd& force);

/// Force on the points to their displacement, 2 modes states (q, q'), continuous. For devices that
/// are given motion (admittance).
[[nodiscard]] StateSpace displacement_of_force(const ModalForceModel& model);

/// Displacement of probes to the forces that press them back, each on a contact spring over its
/// point, both touching: f = (1/stiffness + compliance)^-1 x. For devices that are given force
/// (impedance). @param stiffness of the contact [N/m], > 0, else std::invalid_argument
[[nodiscard]] StateSpace force_of_displacement(const ModalForceModel& model, double stiffness);

}  // namespace reckon::haptics
