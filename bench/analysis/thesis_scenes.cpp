// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/analysis/thesis_scenes.hpp"

#include <cmath>
#include <deque>
#include <stdexcept>

#include "reckon/bench/analysis/sampled_environment.hpp"
#include "reckon/bench/linear_systems/stability.hpp"

namespace reckon::bench {
namespace {

long sample_count(double duration, double sample_period) {
  const double count = std::round(duration / sample_period);
  if (!(sample_period > 0) || !(count >= 0) || !(count <= 1e8)) {
    throw std::invalid_argument(
        "thesis scene: give a sample period above 0 s and 0 to 1e8 samples");
  }
  return static_cast<long>(count);
}

}  // namespace

TransferFunction environment_of(const OneUserScene& s) {
  if (s.order < 1 || s.order > 4) {
    throw std::invalid_argument("thesis scene: the environment's order is 1, 2, 3 or 4");
  }
  const double T = s.sample_period, c = std::cos(s.resonance * T);
  TransferFunction environment = virtual_wall(s.stiffness, s.wall_damping, T, s.reading);
  if (s.order == 2 || s.order == 4) {
    environment = product(environment, {{1 - s.lag_pole, 0}, {1, -s.lag_pole}, T});
  }
  if (s.order >= 3) environment = product(environment, {{2 - 2 * c, 0, 0}, {1, -2 * c, 1}, T});
  return environment;
}

double loop_radius(const OneUserScene& s) {
  const StateSpace device =
      discretise_zero_order_hold(to_state_space(mass_damper(s.mass, s.damping)), s.sample_period);
  return spectral_radius(feedback(device, to_state_space(environment_of(s))));
}

std::vector<SceneSample> run(const OneUserScene& s) { return run(s, environment_of(s)); }

std::vector<SceneSample> run(const OneUserScene& s, const TransferFunction& environment) {
  const long count = sample_count(s.duration, s.sample_period);
  const MassDamper body{s.mass, s.damping};
  SampledEnvironment anywhere(environment);
  UnilateralEnvironment behind_wall(environment);
  std::vector<SceneSample> series;
  MotionState state = s.start;
  for (long k = 0; k <= count; ++k) {
    const double time = static_cast<double>(k) * s.sample_period;
    const double force =
        s.wall ? behind_wall.step(state.position - *s.wall) : anywhere.step(state.velocity);
    series.push_back({time, state.position, state.velocity, force});
    const double push = time >= s.push_from - 1e-9 * s.sample_period ? s.push : 0.0;
    state = advanced(body, state, push - force, s.sample_period);
  }
  return series;
}

std::vector<std::array<SceneSample, 2>> run(const TwoUserScene& scene) {
  const PairParameters& p = scene.pair;
  return run(scene, virtual_wall(p.stiffness, p.wall_damping, p.sample_period, p.reading));
}

std::vector<std::array<SceneSample, 2>> run(const TwoUserScene& scene,
                                            const TransferFunction& environment) {
  const PairParameters& p = scene.pair;
  const long count = sample_count(scene.duration, p.sample_period);
  if (p.delay_samples < 0 || !(p.mass > 0)) {
    throw std::invalid_argument("thesis scene: give a mass above 0 kg and 0 or more samples");
  }
  const MassDamper body{p.mass, p.damping};
  std::array<SampledEnvironment, 2> environments = {SampledEnvironment(environment),
                                                    SampledEnvironment(environment)};
  std::array<MotionState, 2> states;
  std::deque<std::array<double, 2>> line(static_cast<std::size_t>(p.delay_samples));
  std::vector<std::array<SceneSample, 2>> series;
  for (long k = 0; k <= count; ++k) {
    line.push_back({states[0].velocity, states[1].velocity});
    const std::array<double, 2> heard = line.front();
    line.pop_front();
    std::array<SceneSample, 2>& row = series.emplace_back();
    for (std::size_t i = 0; i < 2; ++i) {
      const double force = environments[i].step(states[i].velocity - p.attenuation * heard[1 - i]);
      row[i] = {static_cast<double>(k) * p.sample_period, states[i].position, states[i].velocity,
                force};
      states[i] = advanced(body, states[i], scene.push[i] - force, p.sample_period);
    }
  }
  return series;
}

}  // namespace reckon::bench
