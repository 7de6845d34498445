// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Damping that a device needs to be passive with a sampled environment: thesis (3.5), with delay,
// and for two users. Off-line code.
#pragma once

#include "reckon/bench/linear_systems/transfer_function.hpp"

namespace reckon::bench {

/// Lower limit of the damping [N s/m] with which a device is passive at its port, for a sampled
/// environment held over each sample; and the frequency [rad/s] of that limit. Below 0 if the
/// environment has surplus damping. Infinite if no damping is enough: a pole outside the circle, a
/// multiple pole on it, or a pole on it with a residue that is not positive (a negative spring).
struct DeviceDamping {
  double required = 0.0;
  double angular_frequency = 0.0;
};

/// (3.5): b > T/(2 (1 - cos wT)) Re{(1 - e^{-jwT}) H(e^{jwT})} for 0 <= w <= pi/T, which with VE =
/// H T z/(z - 1) is b > max of -Re{VE/z}. The greatest value is exact to rounding, both ends
/// included, by judge_positive_real(); an integrator's pole at z = 1 adds its limit, K T/2.
///
///     required_device_damping(virtual_wall(0.2, 0.1, 0.01, SpringReading::with_period)) // 0.101
///
/// @param environment VE, speed [m/s] to force [N], sampled
/// @throws std::invalid_argument where it is not sampled, not proper or not finite
[[nodiscard]] DeviceDamping required_device_damping(const TransferFunction& environment);

/// For an environment as a state space with one input and one output. Use this form for high
/// orders: polynomial coefficients lose the separation of poles that lie close together, also of
/// one on the circle.
[[nodiscard]] DeviceDamping required_device_damping(const StateSpace& environment);

/// The same for an environment that is delayed by `delay_samples` >= 0 samples.
[[nodiscard]] DeviceDamping required_device_damping(const TransferFunction& environment,
                                                    int delay_samples);

/// Two equal users; the input of each environment is its user's speed minus the other's speed
/// `delay_samples` ago (thesis Fig 4.1): common motion has VE (1 - z^-d), opposed motion VE (1 +
/// z^-d); returns the greater of both. A spring alone needs K (T + d T).
[[nodiscard]] DeviceDamping required_device_damping_of_pair(const TransferFunction& environment,
                                                            int delay_samples);

/// The expression whose greatest value over w is required_device_damping() of the virtual wall:
/// (3.7) as derived from (3.5), K T/2 - b_e cos(wT); with d samples of delay K T/2 sin((2 d + 1)
/// theta/2)/sin(theta/2) - b_e cos((d + 1) theta).
/// @param theta w T [rad], 0 to pi
[[nodiscard]] double wall_damping_at(double stiffness, double damping, double sample_period,
                                     double theta, int delay_samples = 0);
/// (3.7) as printed, T/2 - b_e cos(wT): without the factor K. Kept for comparison.
[[nodiscard]] double printed_wall_damping_at(double damping, double sample_period, double theta);

/// (3.8), (3.9): K T/2 + |b_e|, no delay.
[[nodiscard]] double wall_damping(double stiffness, double damping, double sample_period);
/// A spring alone, d samples late: K T (d + 1/2).
[[nodiscard]] double spring_damping(double stiffness, double sample_period, int delay_samples);

}  // namespace reckon::bench
