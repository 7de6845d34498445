// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The stiffness that a device can show, by theory: thesis (3.5) solved for the spring.
#pragma once

namespace reckon::bench {

/// A device with one degree of freedom, driven by forces that are held for a period.
struct ZWidthDevice {
  double mass = 0.1;         ///< [kg] > 0
  double damping = 1.0;      ///< [N s/m] > 0, its own
  double period = 1e-3;      ///< [s] > 0
  int delay_samples = 0;     ///< >= 0, until a force is at the handle
  double max_stiffness = 0;  ///< [N/m] of its own; 0: none. What a servo shows heeds it
};

/// Stiffest wall [N/m] with this damping [N s/m] that is passive, exact to 1e-9: where
/// wall_damping_at() reaches the device's damping at one frequency. 0 where |damping| is
/// the device's or more. Cost: some 100 evaluations for each sample of delay.
[[nodiscard]] double passive_stiffness(const ZWidthDevice& device, double wall_damping);

/// (3.8), (3.9), which know no delay: 2 (b - |B|)/T.
[[nodiscard]] double undelayed_stiffness(const ZWidthDevice& device, double wall_damping);

/// What the servo shows of a wall of the scene with this damper [N s/m], which it takes as not
/// negative, asked of a ServoLoop: it keeps a quarter of the device's damping for remote hands, a
/// twentieth as margin, and has a bound for every delay. Period 0.1 to 10 ms. @throws
/// std::invalid_argument
[[nodiscard]] double servo_stiffness(const ZWidthDevice& device, double wall_damping);

}  // namespace reckon::bench
