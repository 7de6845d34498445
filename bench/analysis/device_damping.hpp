// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Passivity of a sampled environment on a device with damping: thesis (3.5) and what follows from
// it, alone, delayed, and between two users. Off-line code.
#pragma once

#include "reckon/bench/linear_systems/transfer_function.hpp"

namespace reckon::bench {

/// The damping [N s/m] that a device must have (more than) for a sampled environment, held over
/// each sample, to be passive at its port; and the frequency [rad/s] that asks for it. Below 0
/// where the environment has damping to spare. Infinite where no damping will do: a pole outside
/// the circle, a multiple one on it, or one on it with a residue that is not positive (a negative
/// spring).
struct DeviceDamping {
  double required = 0.0;
  double angular_frequency = 0.0;
};

/// (3.5): b > T/(2 (1 - cos wT)) Re{(1 - e^{-jwT}) H(e^{jwT})} for 0 <= w <= pi/T, which with
/// VE = H T z/(z - 1) is b > max of -Re{VE/z}. Greatest value exact to rounding, both ends
/// included, as judge_positive_real() finds it; an integrator's pole at z = 1 adds its limit, K
/// T/2.
///
///     required_device_damping(virtual_wall(0.2, 0.1, 0.01, SpringReading::with_period)) // 0.101
///
/// @param environment VE, speed [m/s] to force [N], sampled
/// @throws std::invalid_argument where it is not sampled, not proper or not finite
[[nodiscard]] DeviceDamping required_device_damping(const TransferFunction& environment);

/// Of an environment as a state space with one input and one output. Take this form for high
/// orders: polynomial coefficients blur poles that lie close together, one on the circle among
/// them.
[[nodiscard]] DeviceDamping required_device_damping(const StateSpace& environment);

/// The same where the environment is felt `delay_samples` >= 0 samples late.
[[nodiscard]] DeviceDamping required_device_damping(const TransferFunction& environment,
                                                    int delay_samples);

/// Two equal users, each environment fed with the own speed minus the other's of `delay_samples`
/// ago (thesis Fig 4.1): common motion feels VE (1 - z^-d), opposed motion VE (1 + z^-d); the
/// greater of both. A spring alone needs K (T + d T).
[[nodiscard]] DeviceDamping required_device_damping_of_pair(const TransferFunction& environment,
                                                            int delay_samples);

/// Expression whose greatest value over w is required_device_damping() of the virtual wall:
/// (3.7) as it follows from (3.5), K T/2 - b_e cos(wT); with d samples of delay
/// K T/2 sin((2 d + 1) theta/2)/sin(theta/2) - b_e cos((d + 1) theta).
/// @param theta w T [rad], 0 to pi
[[nodiscard]] double wall_damping_at(double stiffness, double damping, double sample_period,
                                     double theta, int delay_samples = 0);
/// (3.7) as printed, T/2 - b_e cos(wT): without the K. Kept for comparison.
[[nodiscard]] double printed_wall_damping_at(double damping, double sample_period, double theta);

/// (3.8), (3.9): K T/2 + |b_e|, no delay.
[[nodiscard]] double wall_damping(double stiffness, double damping, double sample_period);
/// A spring alone, d samples late: K T (d + 1/2).
[[nodiscard]] double spring_damping(double stiffness, double sample_period, int delay_samples);

}  // namespace reckon::bench
