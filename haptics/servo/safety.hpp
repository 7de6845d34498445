// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The last stage before the device: limits, trips, the operator's switch.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "reckon/haptics/devices/haptic_device.hpp"

namespace reckon::haptics {

/// Why the force was cut to zero in a step.
enum class Trip : std::uint8_t { none, not_finite, overspeed, no_reading, watchdog };

/// Decides what part of a wanted force may reach the hand. It only ever scales: direction is kept,
/// and the caller scales the storage of its contacts by the same factor, so that the energy books
/// stay exact. After a trip or a released switch the force is 0 and stays so for `hold`; then the
/// contacts ramp up again by themselves, paid by their ledgers.
class Safety {
 public:
  /// @param max_force [N] > 0, magnitude of the total force
  /// @param max_power [W] > 0, that the force puts into a hand which gives way to it
  /// @param max_speed [m/s] > 0, of the handle
  /// @param hold_steps samples of zero force after a trip
  Safety(double max_force, double max_power, double max_speed, int hold_steps) noexcept;

  /// Call once a step, first. @param velocity [m/s], of the handle, any frame.
  /// @return true when forces may be rendered in this step.
  [[nodiscard]] bool admit(const DeviceSample& sample, const Eigen::Vector3d& velocity) noexcept;

  /// Factor in [0, 1] for the wanted total force [N]; 0 and a trip when it is not finite. Power is
  /// that of the hand's velocity [m/s] now: what it gains within the sample is not foreseen.
  [[nodiscard]] double scale(const Eigen::Vector3d& wanted,
                             const Eigen::Vector3d& velocity) noexcept;

  /// Trips since construction; one for each cause that begins.
  [[nodiscard]] std::uint64_t trips() const noexcept { return trips_; }
  [[nodiscard]] Trip last_trip() const noexcept { return last_; }

 private:
  void trip(Trip cause) noexcept;

  double max_force_;
  double max_power_;
  double max_speed_;
  int hold_steps_;
  int held_ = 0;
  std::uint64_t trips_ = 0;
  Trip last_ = Trip::none;
};

}  // namespace reckon::haptics
