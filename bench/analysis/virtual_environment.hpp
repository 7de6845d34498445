// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Virtual environments (VE) of the thesis as transfer functions from speed [m/s] to force [N], the
// device, and the hold. Off-line code: no scene uses them.
#pragma once

#include <complex>

#include "reckon/bench/linear_systems/transfer_function.hpp"

namespace reckon::bench {

/// The thesis prints the sum of the spring in two forms, which differ by the factor T.
enum class SpringReading {
  with_period,     ///< "K with T": K T z/(z - 1), (3.6) and (4.6): K is a stiffness [N/m]
  without_period,  ///< "K, no T": K z/(z - 1), (4.21) and (5.5): the stiffness is K/T
};

/// (3.6): b_e + K s^-1 at s = (z - 1)/(T z), that is ((b_e + k) z - b_e)/(z - 1), k = K T or K.
/// @param stiffness K [N/m] or [N s/m], depends on the reading @param damping b_e [N s/m], any sign
/// @param sample_period T [s] > 0
[[nodiscard]] TransferFunction virtual_wall(double stiffness, double damping, double sample_period,
                                            SpringReading reading);

/// Position-to-force form of a speed-to-force environment: VE (z - 1)/(T z), called H in (3.5). The
/// thesis also writes VE(jw) = H(jw)/(jw) and so mixes s and z.
[[nodiscard]] TransferFunction position_form(const TransferFunction& environment);
/// The inverse of position_form(): H T z/(z - 1).
[[nodiscard]] TransferFunction velocity_form(const TransferFunction& position_to_force);

/// (5.4): b + K_c z/(z (z - 1)). The z cancels, which leaves a first-order model that is one sample
/// late. Thesis: b = 0.4, K_c = 0.1.
[[nodiscard]] TransferFunction complex_environment(double damping, double gain,
                                                   double sample_period);
/// (5.5): b + K_s z/(z - 1). Thesis: K_s = 0.9, nine times the value that (4.21) gives for (5.4),
/// which is K_s = K_c.
[[nodiscard]] TransferFunction simple_environment(double damping, double gain,
                                                  double sample_period);

/// (4.21) before the reduction: K z/((z - a)(z - alpha)). The thesis prints no numbers.
[[nodiscard]] TransferFunction two_pole_environment(double gain, double a, double alpha,
                                                    double sample_period);
/// (4.21) after the reduction: (K z/(1 - alpha))/(z - a), with the pole alpha replaced by its
/// static gain.
/// @throws std::invalid_argument if alpha is 1
[[nodiscard]] TransferFunction one_pole_environment(double gain, double a, double alpha,
                                                    double sample_period);

/// Device (m s + b)^-1, force to speed, in s. @param mass [kg] > 0  @param damping [N s/m]
[[nodiscard]] TransferFunction mass_damper(double mass, double damping);
/// (4.4), (4.5): the same by backward difference, gain T z/((m + b T) z - m), times `gain`, which
/// the thesis never states. It hides the cost K T/2 of sampling: use discretise_zero_order_hold().
[[nodiscard]] TransferFunction backward_difference_device(double mass, double damping, double gain,
                                                          double sample_period);

/// (4.7) as printed: (z + 1)/(2 z) at z = e^{j theta}. @param theta w T [rad]
[[nodiscard]] std::complex<double> printed_hold(double theta);
/// Zero-order hold with sampler: e^{-j theta/2} sin(theta/2)/(theta/2). It has the same phase as
/// printed_hold and another amplitude: 0.64 at theta = pi, where printed_hold is 0.
[[nodiscard]] std::complex<double> zero_order_hold(double theta);

}  // namespace reckon::bench
