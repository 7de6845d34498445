// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/analysis/virtual_environment.hpp"

#include <cmath>

namespace reckon::bench {

TransferFunction virtual_wall(double stiffness, double damping, double sample_period,
                              SpringReading reading) {
  const double gain = reading == SpringReading::with_period ? stiffness * sample_period : stiffness;
  return simple_environment(damping, gain, sample_period);
}

TransferFunction position_form(const TransferFunction& environment) {
  const double T = environment.sample_period;
  return product(environment, {{1, -1}, {T, 0}, T});
}

TransferFunction velocity_form(const TransferFunction& position_to_force) {
  const double T = position_to_force.sample_period;
  return product(position_to_force, {{T, 0}, {1, -1}, T});
}

TransferFunction complex_environment(double damping, double gain, double sample_period) {
  return checked({{damping, gain - damping}, {1, -1}, sample_period});
}

TransferFunction simple_environment(double damping, double gain, double sample_period) {
  return checked({{damping + gain, -damping}, {1, -1}, sample_period});
}

TransferFunction two_pole_environment(double gain, double a, double alpha, double sample_period) {
  return checked({{gain, 0}, {1, -a - alpha, a * alpha}, sample_period});
}

TransferFunction one_pole_environment(double gain, double a, double alpha, double sample_period) {
  return checked({{gain / (1 - alpha), 0}, {1, -a}, sample_period});
}

TransferFunction mass_damper(double mass, double damping) {
  return checked({{1}, {mass, damping}, 0.0});
}

TransferFunction backward_difference_device(double mass, double damping, double gain,
                                            double sample_period) {
  return checked(
      {{sample_period * gain, 0}, {mass + damping * sample_period, -mass}, sample_period});
}

std::complex<double> printed_hold(double theta) { return 0.5 * (1.0 + std::polar(1.0, -theta)); }

std::complex<double> zero_order_hold(double theta) {
  const double half = 0.5 * theta;
  return std::polar(half == 0 ? 1.0 : std::sin(half) / half, -half);
}

}  // namespace reckon::bench
