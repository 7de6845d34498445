// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/analysis/device_damping.hpp"

#include <cmath>
#include <stdexcept>

#include "reckon/bench/linear_systems/positive_real.hpp"

namespace reckon::bench {
namespace {

// 1 + sign z^-samples
TransferFunction with_echo(int samples, double sign, double sample_period) {
  TransferFunction echo{{1}, {1}, sample_period};
  echo.numerator.resize(static_cast<std::size_t>(samples) + 1);
  echo.numerator.back() += sign;
  echo.denominator.resize(static_cast<std::size_t>(samples) + 1);
  return echo;
}

void require_sampled(double sample_period) {
  if (sample_period > 0) return;
  throw std::invalid_argument(
      "device damping: the environment must be sampled; give it in z, with its period");
}

// -Re{VE/z}, given VE/z: the hold delays the environment by one sample.
DeviceDamping needed(const StateSpace& environment_one_late) {
  const PositiveRealReport report = judge_positive_real(environment_one_late);
  return {-report.least, report.angular_frequency};
}

}  // namespace

DeviceDamping required_device_damping(const TransferFunction& environment) {
  return required_device_damping(environment, 0);
}

DeviceDamping required_device_damping(const TransferFunction& environment, int delay_samples) {
  require_sampled(environment.sample_period);
  return needed(to_state_space(delayed(environment, delay_samples + 1)));
}

DeviceDamping required_device_damping(const StateSpace& environment) {
  require_sampled(environment.sample_period);
  if (environment.inputs() != 1 || environment.outputs() != 1) {
    throw std::invalid_argument("device damping: an environment has one input and one output");
  }
  return needed(series(environment, sample_delay(1, 1, environment.sample_period)));
}

DeviceDamping required_device_damping_of_pair(const TransferFunction& environment,
                                              int delay_samples) {
  if (delay_samples < 0) {
    throw std::invalid_argument("device damping: a delay must be 0 or more samples");
  }
  const double T = environment.sample_period;
  const DeviceDamping common =
      required_device_damping(product(environment, with_echo(delay_samples, -1.0, T)));
  const DeviceDamping opposed =
      required_device_damping(product(environment, with_echo(delay_samples, 1.0, T)));
  return common.required > opposed.required ? common : opposed;
}

double wall_damping_at(double stiffness, double damping, double sample_period, double theta,
                       int delay_samples) {
  const double half = std::sin(0.5 * theta);
  const double late = 2.0 * delay_samples + 1.0;
  const double spring = half == 0 ? late : std::sin(0.5 * late * theta) / half;
  return 0.5 * stiffness * sample_period * spring - damping * std::cos((delay_samples + 1) * theta);
}

double printed_wall_damping_at(double damping, double sample_period, double theta) {
  return 0.5 * sample_period - damping * std::cos(theta);
}

double wall_damping(double stiffness, double damping, double sample_period) {
  return 0.5 * stiffness * sample_period + std::abs(damping);
}

double spring_damping(double stiffness, double sample_period, int delay_samples) {
  return stiffness * sample_period * (delay_samples + 0.5);
}

}  // namespace reckon::bench
