// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Networks of ports with an effort F [N] and a flow V [m/s] into the network: F_1 V_1 + F_2 V_2 is
// the power into it. (The thesis counts V_2 outwards.) Off-line code.
#pragma once

#include <Eigen/Core>
#include <complex>

#include "reckon/bench/linear_systems/state_space.hpp"

namespace reckon::bench {

/// Input and output of a one-port or a display.
enum class Causality {
  impedance,   ///< flow in, effort out
  admittance,  ///< effort in, flow out
};

/// A linear one-port: one input, one output.
struct OnePort {
  Causality causality = Causality::impedance;
  StateSpace system;

  /// F/V [N s/m] at an angular frequency [rad/s], for either causality. Infinite if V is 0.
  [[nodiscard]] std::complex<double> impedance_at(double angular_frequency) const;
  /// V/F, its inverse.
  [[nodiscard]] std::complex<double> admittance_at(double angular_frequency) const;
};

enum class PortForm {
  impedance,       ///< (F1, F2) = M (V1, V2)
  admittance,      ///< (V1, V2) = M (F1, F2)
  hybrid,          ///< (F1, V2) = M (V1, F2)
  inverse_hybrid,  ///< (V1, F2) = M (F1, V2), the "hybrid matrix" of (4.12)
  chain,           ///< (F1, V1) = M (F2, -V2): matrices of a cascade multiply
};

/// A two-port at one frequency.
struct TwoPortMatrix {
  PortForm form = PortForm::impedance;
  Eigen::Matrix2cd matrix;
};

/// The same two-port in another form. @throws std::invalid_argument if that form does not exist (a
/// wire has no impedance matrix), or if an entry is not finite
[[nodiscard]] TwoPortMatrix converted(const TwoPortMatrix& two_port, PortForm form);

/// Port 2 of `first` connected to port 1 of `second`; in chain form. @throws as converted()
[[nodiscard]] TwoPortMatrix cascade(const TwoPortMatrix& first, const TwoPortMatrix& second);

/// Impedance at port 1 with a one-port of impedance `load` connected to port 2. @throws as
/// converted()
[[nodiscard]] std::complex<double> driving_impedance(const TwoPortMatrix& two_port,
                                                     std::complex<double> load);

/// A two-port as a system of two inputs and outputs, in any form but the chain:
/// judge_positive_real() accepts its system without conversion.
struct TwoPort {
  PortForm form = PortForm::impedance;
  StateSpace system;

  [[nodiscard]] TwoPortMatrix at(double angular_frequency) const;
};

/// (3.3) and (3.4) at one frequency, corrected: the least of Re p11, Re p22 and Re p11 Re p22 -
/// |(p21 + conj p12)/2|^2. >= 0 if the immittance matrix P only absorbs power.
[[nodiscard]] double passivity_margin(const Eigen::Matrix2cd& P);
/// (3.4) as printed, without the conjugate: a transmission line, which is lossless, fails it, and
/// the delayed junction of (4.12), which produces energy, passes.
[[nodiscard]] double printed_passivity_margin(const Eigen::Matrix2cd& P);
/// Llewellyn: the least of Re p11, Re p22 and 2 Re p11 Re p22 - Re(p12 p21) - |p12 p21|. If it is
/// >= 0 at all frequencies, the two-port is stable between any two passive one-ports; this is
/// weaker than passivity.
[[nodiscard]] double llewellyn_margin(const Eigen::Matrix2cd& P);

}  // namespace reckon::bench
