// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The last stage before the device: limits, trips and the operator's switch.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>

#include "reckon/haptics/devices/haptic_device.hpp"
#include "reckon/haptics/passivity/wrench.hpp"
#include "reckon/haptics/servo/motor_heat.hpp"

namespace reckon::haptics {

/// Why a step cut the force to zero.
enum class Trip : std::uint8_t { none, not_finite, overspeed, no_reading, watchdog };

/// Admission of a step's force.
enum class Admission : std::uint8_t {
  shown,   ///< forces are rendered
  paused,  ///< no force in this step, because its reading failed; the contacts keep their state
  cut,     ///< no force, and the contacts release
};

/// Decides which share of a wanted force may reach the hand. It only scales, so the direction
/// stays, and the caller scales the storage of its contacts by the same factor to keep the energy
/// accounts exact. After a trip the force is 0 for `hold`. Then the contacts ramp up again by
/// themselves, paid by the port. At the start, and after each cut, the force limit rises from 0
/// over kRampSteps. It falls when the motors become warm (MotorHeat). A single failed reading
/// pauses the force for that step, and the next step accounts for the motion of the hand. More than
/// kMostMissed failed readings in half a second are a trip.
class Safety {
 public:
  /// @param max_force [N] > 0, magnitude of the total force
  /// @param max_power [W] > 0, power of the force on a hand that yields to it
  /// @param max_speed [m/s] > 0, of the handle
  /// @param hold_steps samples of zero force after a trip
  Safety(double max_force, double max_power, double max_speed, int hold_steps) noexcept;

  /// Most failed readings, in a row or within kForgiven samples, that are not yet a trip.
  static constexpr int kMostMissed = 3;
  static constexpr int kForgiven = 500;
  /// Samples of the linear rise of the limits of force and torque after a cut.
  static constexpr int kRampSteps = 100;

  /// For a device of 6 axes. @param max_torque [N m] > 0 @param max_turn [rad/s] > 0
  void limit_turns(double max_torque, double max_turn) noexcept {
    max_torque_ = max_torque;
    max_turn_ = max_turn;
  }

  /// Sets the thermal limit of the motors. @param continuous [N] > 0, their continuous force @param
  /// steps their thermal time constant in samples, see MotorHeat
  void limit_heat(double continuous, double steps) noexcept {
    heat_ = MotorHeat(continuous / max_force_, steps);
  }

  /// Call first in each step. @param velocity [m/s], of the handle, any frame.
  [[nodiscard]] Admission admit(const DeviceSample& sample,
                                const Eigen::Vector3d& velocity) noexcept;
  /// @param twist velocity [m/s], then turn rate [rad/s]
  [[nodiscard]] Admission admit(const DeviceSample& sample, const Wrench& twist) noexcept;

  /// Factor in [0, 1] for the wanted total force [N]. A force that is not finite gives 0 and a
  /// trip. The power limit uses the present velocity of the hand [m/s] and does not predict its
  /// acceleration within the sample.
  [[nodiscard]] double scale(const Eigen::Vector3d& wanted,
                             const Eigen::Vector3d& velocity) noexcept;
  /// @param wanted force [N], then torque [N m], on the handle
  [[nodiscard]] double scale(const Wrench& wanted, const Wrench& twist) noexcept;

  /// Whether the limits are still rising.
  [[nodiscard]] bool ramps() const noexcept { return shown_ < kRampSteps; }
  /// Trips since construction. Each cause counts once when it begins.
  [[nodiscard]] std::uint64_t trips() const noexcept { return trips_; }
  [[nodiscard]] Trip last_trip() const noexcept { return last_; }

 private:
  [[nodiscard]] Admission admit(const DeviceSample& sample, bool finite, bool fast) noexcept;
  [[nodiscard]] double within_limits(double excess, double power) noexcept;
  void trip(Trip cause) noexcept;

  double max_force_;
  double max_power_;
  double max_speed_;
  double max_torque_ = 0.0;
  double max_turn_ = 0.0;
  MotorHeat heat_;
  double showing_ = 0.0;  // share of the greatest force in this step
  int hold_steps_;
  int held_ = 0;
  int shown_ = 0;     // samples since the last cut, at most kRampSteps
  int missed_ = 0;    // failed readings within kForgiven samples
  int forgiven_ = 0;  // samples until the failures are forgotten
  std::uint64_t trips_ = 0;
  Trip last_ = Trip::none;
};

}  // namespace reckon::haptics
