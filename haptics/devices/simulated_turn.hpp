// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Simulates the rotation of a handle of six axes under a held torque and a hand.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace reckon::haptics {

/// @throws std::invalid_argument unless `good`: "simulated device: {what}, got {value}"
void require_of_simulated(bool good, const char* what, double value);

/// Rotational axes of a simulated device.
struct SimulatedTurnConfig {
  double inertia = 1e-4;        ///< [kg m^2], > 0; about each axis
  double damping = 0.01;        ///< [N m s/rad], > 0; all of it counts as guaranteed
  double hand_stiffness = 1.0;  ///< [N m/rad], the hand's spring to its target; 0: no hand
  double hand_damping = 0.02;   ///< [N m s/rad]
  double max_torque = 1.0;      ///< [N m], reported limit
  double resolution = 0.0;      ///< [rad], step of the angle sensors; 0: exact
  Eigen::Quaterniond start = Eigen::Quaterniond::Identity();  ///< tool -> D
};

/// A rotor with the same inertia and friction about each axis, in frame D. Its energy books are
/// exact for its steps, as in SimulatedDevice.
class SimulatedTurn {
 public:
  /// @throws std::invalid_argument for values out of range.
  explicit SimulatedTurn(const SimulatedTurnConfig& config);

  /// One step of `h` [s] under the held torque [N m] and a hand with this target.
  /// @param grip share of the hand's spring and damper, 0 to 1
  void step(const Eigen::Vector3d& torque, const Eigen::Quaterniond& target,
            const Eigen::Vector3d& target_rate, double grip, double h) noexcept;
  void restart(const Eigen::Quaterniond& orientation, const Eigen::Vector3d& rate) noexcept;

  [[nodiscard]] const Eigen::Quaterniond& orientation() const noexcept { return orientation_; }
  /// Orientation as its sensors measure it.
  [[nodiscard]] Eigen::Quaterniond reading() const noexcept;
  [[nodiscard]] const Eigen::Vector3d& rate() const noexcept { return rate_; }  ///< [rad/s]
  /// Work of the handle against the held torques since the start [J].
  [[nodiscard]] double port_work() const noexcept { return port_work_; }
  [[nodiscard]] double damping_loss() const noexcept { return damping_loss_; }
  [[nodiscard]] double hand_work() const noexcept { return hand_work_; }
  [[nodiscard]] const SimulatedTurnConfig& config() const noexcept { return config_; }

 private:
  SimulatedTurnConfig config_;
  Eigen::Quaterniond orientation_;
  Eigen::Vector3d rate_ = Eigen::Vector3d::Zero();
  double port_work_ = 0.0;
  double damping_loss_ = 0.0;
  double hand_work_ = 0.0;
};

}  // namespace reckon::haptics
