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

/// What a step may do.
enum class Admission : std::uint8_t {
  shown,   ///< forces are rendered
  paused,  ///< none in this step, for its reading failed; what contacts hold is kept
  cut,     ///< none: contacts let go
};

/// Decides what part of a wanted force may reach the hand. It only ever scales: direction is kept,
/// and the caller scales the storage of its contacts by the same factor, so that the energy books
/// stay exact. After a trip or a released switch the force is 0 and stays so for `hold`; then the
/// contacts ramp up again by themselves, paid by the port. A reading that fails by itself pauses
/// the force for that step: what the hand did meanwhile is booked by the next one. Where more than
/// kMostMissed of them fail in half a second it is a trip.
class Safety {
 public:
  /// @param max_force [N] > 0, magnitude of the total force
  /// @param max_power [W] > 0, that the force puts into a hand which gives way to it
  /// @param max_speed [m/s] > 0, of the handle
  /// @param hold_steps samples of zero force after a trip
  Safety(double max_force, double max_power, double max_speed, int hold_steps) noexcept;

  /// Failed readings in a row, or within kForgiven samples, that are no trip yet.
  static constexpr int kMostMissed = 3;
  static constexpr int kForgiven = 500;

  /// Call once a step, first. @param velocity [m/s], of the handle, any frame.
  [[nodiscard]] Admission admit(const DeviceSample& sample,
                                const Eigen::Vector3d& velocity) noexcept;

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
  int missed_ = 0;    // readings that failed within kForgiven samples
  int forgiven_ = 0;  // samples until that is forgotten
  std::uint64_t trips_ = 0;
  Trip last_ = Trip::none;
};

}  // namespace reckon::haptics
