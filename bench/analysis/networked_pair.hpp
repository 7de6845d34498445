// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Two equal devices: the input of each environment is the speed of its device minus the delayed
// speed of the other. Thesis Figs 4.1 and 4.2, as printed and as derived. Off-line code.
#pragma once

#include <Eigen/Core>
#include <complex>

#include "reckon/bench/analysis/virtual_environment.hpp"
#include "reckon/bench/linear_systems/state_space.hpp"
#include "reckon/bench/linear_systems/transfer_function.hpp"

namespace reckon::bench {

/// Both sides are equal; defaults from the thesis.
struct PairParameters {
  double mass = 1.0;            ///< [kg] > 0
  double damping = 0.3;         ///< b of the device [N s/m]
  double device_gain = 1.0;     ///< K of (4.4), never given in the thesis
  double stiffness = 0.2;       ///< K_e, depends on the reading
  double wall_damping = 0.1;    ///< b_e [N s/m]
  double sample_period = 0.01;  ///< T [s] > 0
  int delay_samples = 1;        ///< of the other's speed, >= 0
  double attenuation = 1.0;     ///< factor on the other's speed
  SpringReading reading = SpringReading::with_period;
};

/// G of (4.1) as printed, by (4.4), (4.6) and (4.7) with one sample of delay, at theta = w T [rad].
/// It is an open-loop graph: without the local loop, and with the sign of the coupling reversed.
[[nodiscard]] Eigen::Matrix2cd printed_pair(const PairParameters& pair, double theta);

/// (F1, F2) to (V1, V2) as derived from the block diagram. With L = HD VE ZOH, D the delay with its
/// attenuation, P = HD/(1 + L), Q = D L/(1 + L): V1 = (P F1 + Q P F2)/(1 - Q^2), V2 likewise.
/// @param device HD @param environment VE times the hold @param delay D, all at one frequency
[[nodiscard]] Eigen::Matrix2cd closed_pair(std::complex<double> device,
                                           std::complex<double> environment,
                                           std::complex<double> delay);

/// The sampled loop with the true hold (exact zero-order-hold device): inputs F1, F2 held over each
/// sample, outputs V1, V2 and the environments' forces. @throws std::invalid_argument for bad
/// numbers
[[nodiscard]] StateSpace pair_loop(const PairParameters& pair);

/// Spectral radii of common (v1 = v2) and opposed (v1 = -v2) motion of pair_loop().
struct PairRadii {
  double common = 0.0, opposed = 0.0;
};
[[nodiscard]] PairRadii pair_radii(const PairParameters& pair);
/// The same with any environment instead of the wall. @throws std::invalid_argument if its sample
/// period differs
[[nodiscard]] PairRadii pair_radii(const PairParameters& pair, const TransferFunction& environment);
/// PairRadii::opposed alone, at half the cost.
[[nodiscard]] double opposed_radius(const PairParameters& pair);
[[nodiscard]] double opposed_radius(const PairParameters& pair,
                                    const TransferFunction& environment);

/// X of (4.8), (4.9): T^2 K^2/(4 (1 - cos w) {M^2 - 2 m M cos w + m^2}^2), M = m + b T.
[[nodiscard]] double printed_scale(const PairParameters& pair, double theta);
/// g12/X by the product in (4.1): the correct value for (4.8) and (4.9).
[[nodiscard]] std::complex<double> direct_g12(const PairParameters& pair, double theta);
/// The same in closed form, (4.8) and (4.9) corrected.
[[nodiscard]] std::complex<double> corrected_g12(const PairParameters& pair, double theta);
/// (4.8) + j (4.9) as printed, with the K T of (4.8) read as K_e T: K is the device's gain, which X
/// already contains. Only the b_e part of (4.9) is right.
[[nodiscard]] std::complex<double> printed_g12(const PairParameters& pair, double theta);

/// (4.10): Re g11 Re g22 - |g12|^2 of (4.1), which according to the thesis is >= 0 for
/// unconditional stability. With any spring it is below 0 at low frequency, because |g12| grows
/// like 1/w.
[[nodiscard]] double unconditional_margin(const PairParameters& pair, double theta);

}  // namespace reckon::bench
