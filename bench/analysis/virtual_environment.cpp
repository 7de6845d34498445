// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/analysis/virtual_environment.hpp"

#include <cmath>

namespace reckon::bench {

haptics::TransferFunction virtual_wall(double stiffness, double damping, double sample_period,
                                       SpringReading reading) {
  const double gain = reading == SpringReading::with_period ? stiffness * sample_period : stiffness;
  return simple_environment(damping, gain, sample_period);
}

haptics::TransferFunction position_form(const haptics::TransferFunction& environment) {
  const double T = environment.sample_period;
  return haptics::product(environment, {{1, -1}, {T, 0}, T});
}

haptics::TransferFunction velocity_form(const haptics::TransferFunction& position_to_force) {
  const double T = position_to_force.sample_period;
  return haptics::product(position_to_force, {{T, 0}, {1, -1}, T});
}

haptics::TransferFunction complex_environment(double damping, double gain, double sample_period) {
  return haptics::checked({{damping, gain - damping}, {1, -1}, sample_period});
}

haptics::TransferFunction simple_environment(double damping, double gain, double sample_period) {
  return haptics::checked({{damping + gain, -damping}, {1, -1}, sample_period});
}

haptics::TransferFunction two_pole_environment(double gain, double a, double alpha,
                                               double sample_period) {
  return haptics::checked({{gain, 0}, {1, -a - alpha, a * alpha}, sample_period});
}

haptics::TransferFunction one_pole_environment(double gain, double a, double alpha,
                                               double sample_period) {
  return haptics::checked({{gain / (1 - alpha), 0}, {1, -a}, sample_period});
}

haptics::TransferFunction mass_damper(double mass, double damping) {
  return haptics::checked({{1}, {mass, damping}, 0.0});
}

haptics::TransferFunction backward_difference_device(double mass, double damping, double gain,
                                                     double sample_period) {
  return haptics::checked(
      {{sample_period * gain, 0}, {mass + damping * sample_period, -mass}, sample_period});
}

std::complex<double> printed_hold(double theta) { return 0.5 * (1.0 + std::polar(1.0, -theta)); }

std::complex<double> zero_order_hold(double theta) {
  const double half = 0.5 * theta;
  return std::polar(half == 0 ? 1.0 : std::sin(half) / half, -half);
}

}  // namespace reckon::bench
