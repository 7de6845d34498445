// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The theoretical stiffness limit of a device: thesis (3.5) solved for the spring.
#pragma once

namespace reckon::bench {

/// A device with one degree of freedom, driven by forces that are held for a period.
struct ZWidthDevice {
  double mass = 0.1;         ///< [kg] > 0
  double damping = 1.0;      ///< [N s/m] > 0, its own
  double period = 1e-3;      ///< [s] > 0
  int delay_samples = 0;     ///< >= 0, until a force acts on the handle
  double max_stiffness = 0;  ///< [N/m] of the device; 0: none. It limits the servo's wall only
};

/// Greatest stiffness [N/m] of a wall with this damping [N s/m] that is passive, exact to 1e-9:
/// there wall_damping_at() reaches the device's damping at one frequency. 0 if |damping| is not
/// below the device's. Cost: about 100 evaluations for each sample of delay.
[[nodiscard]] double passive_stiffness(const ZWidthDevice& device, double wall_damping);

/// (3.8), (3.9), without a delay: 2 (b - |B|)/T.
[[nodiscard]] double undelayed_stiffness(const ZWidthDevice& device, double wall_damping);

/// Stiffness that the servo shows for a wall of the scene with this damper [N s/m], whose damping
/// it takes as not negative; computed by a ServoLoop. It reserves a quarter of the device's damping
/// for remote hands and a twentieth as margin, and has a bound for every delay. Period 0.1 to 10
/// ms. @throws std::invalid_argument
[[nodiscard]] double servo_stiffness(const ZWidthDevice& device, double wall_damping);

}  // namespace reckon::bench
