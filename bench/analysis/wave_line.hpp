// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A junction with delay between two ports: effort and flow sent unchanged, thesis (4.12), and the
// lossless transmission line that sends waves instead, (4.14) to (4.16). Off-line code.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "reckon/bench/analysis/two_port.hpp"

namespace reckon::bench {

/// (4.12): V1 = z^-1 V2, F2 = -z^-1 F1, in inverse hybrid form. @param theta w T
/// [rad]
[[nodiscard]] TwoPortMatrix delayed_junction(double theta);

/// Eigenvalues of P + P^H, ascending. (4.13) prints +-2j sin(wT) for the delayed junction; the
/// matrix is Hermitian and they are real, +-2 sin(wT): active at every delay except for wT = n pi.
[[nodiscard]] Eigen::Vector2d power_eigenvalues(const TwoPortMatrix& immittance);

/// A line with total mass M [kg] and total stiffness K [N/m], as one spring: Z_0 = sqrt(M K), delay
/// sqrt(M/K). (The thesis has K = k L for stiffness k per length; springs in series give k/L.)
struct LineParameters {
  double impedance = 1.0;  ///< Z_0 [N s/m] > 0
  double delay = 0.0;      ///< one way [s]
};
[[nodiscard]] LineParameters line_of(double mass, double stiffness);

/// Impedance matrix at s = j w: Z_0 [coth Ts, csch Ts; csch Ts, coth Ts]. Not finite if lambda^2 =
/// e^{-2jwT} is 1: these are poles on the border with residues >= 0, so that the line is lossless
/// there too.
[[nodiscard]] TwoPortMatrix transmission_line(const LineParameters& line, double angular_frequency);
/// (4.14), (4.15) as printed: the diagonal has the opposite sign, because the flows are counted
/// outwards there. It maps flows to efforts, so it is an impedance matrix, although the thesis
/// calls it hybrid.
[[nodiscard]] TwoPortMatrix printed_transmission_line(const LineParameters& line,
                                                      double angular_frequency);

/// The line in time: flows in, efforts out, a whole number of samples late. Lossless for any motion
/// of its ends: the energy received and not yet returned is in transit. Waves u = (F + Z V)/(2 sqrt
/// Z) out and v = (F - Z V)/(2 sqrt Z) in, with u^2 - v^2 = F V.
class WaveLine {
 public:
  struct Ends {
    double a = 0.0, b = 0.0;
  };

  /// @param impedance [N s/m] > 0  @param delay_samples >= 1  @param sample_period [s] > 0
  /// @throws std::invalid_argument otherwise
  WaveLine(double impedance, int delay_samples, double sample_period);

  /// One sample: efforts [N] at both ends for the flows [m/s] into them.
  Ends step(const Ends& flows);
  /// Energy in transit [J].
  [[nodiscard]] double stored() const;

 private:
  double root_;  // sqrt Z
  double sample_period_;
  std::vector<Ends> on_the_way_;  // ring: the waves that left each end
  std::size_t oldest_ = 0;
};

}  // namespace reckon::bench
