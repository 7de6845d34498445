// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/baselines/coupling_end.hpp"

#include <cmath>
#include <stdexcept>

#include "reckon/bench/baselines/effort_flow_end.hpp"
#include "reckon/bench/baselines/local_model_end.hpp"
#include "reckon/bench/baselines/reckon_end.hpp"
#include "reckon/bench/baselines/velocity_exchange_end.hpp"
#include "reckon/bench/baselines/wave_end.hpp"

namespace reckon::bench {
namespace {

using End = std::unique_ptr<CouplingEnd>;

void demand(bool good, const char* what) {
  if (!good) throw std::invalid_argument(std::string("coupling: ") + what);
}

void check(const CouplingEndConfig& config) {
  const auto above_0 = [](double x) { return x > 0 && std::isfinite(x); };
  demand(above_0(config.period), "the sample period must be above 0 s");
  demand(above_0(config.damping), "the device's damping must be above 0 N s/m");
  demand(above_0(config.mass), "the mass must be above 0 kg");
  demand(above_0(config.impedance), "the line's impedance must be above 0 N s/m");
  demand(config.gain >= 0 && config.gain <= 1, "the gain must be 0 to 1");
  demand(config.counterpart == Counterpart::server ||
             config.environment.kind() == EnvironmentKind::linear,
         "two hands press on a linear spring: use the environment linear, or a server");
}

// The end that has the spring, if only one end has it.
bool is_world(const CouplingEndConfig& config) { return config.side == CouplingSide::second; }

bool is_server(const CouplingEndConfig& config) {
  return is_world(config) && config.counterpart == Counterpart::server;
}

End junction_end(const CouplingEndConfig& config) {
  if (is_world(config)) return std::make_unique<EffortEnd>(config);
  return std::make_unique<FlowEnd>();
}

// Two hands exchange their positions; a server sends the force.
End gain_cut_end(const CouplingEndConfig& config) {
  if (config.counterpart == Counterpart::server) return junction_end(config);
  return std::make_unique<LocalModelEnd>(config, config.gain, false);
}

End model_end(const CouplingEndConfig& config) {
  if (is_server(config)) return std::make_unique<TangentServer>(config);
  if (config.mode == CouplingMode::reckon) return std::make_unique<ReckonEnd>(config);
  if (config.mode == CouplingMode::passivity_controller)
    return std::make_unique<PassivityControllerEnd>(config);
  return std::make_unique<LocalModelEnd>(config, 1.0, true);
}

End wave_end(const CouplingEndConfig& config) {
  if (is_world(config)) return std::make_unique<WaveWorldEnd>(config);
  return std::make_unique<WaveHandEnd>(config);
}

End velocity_end(const CouplingEndConfig& config) {
  if (is_server(config)) return std::make_unique<SurfaceSpeedServer>(config);
  return std::make_unique<VelocityExchangeEnd>(config);
}

}  // namespace

std::unique_ptr<CouplingEnd> make_coupling_end(const CouplingEndConfig& config) {
  check(config);
  switch (config.mode) {
    case CouplingMode::velocity_exchange:
      return velocity_end(config);
    case CouplingMode::effort_flow:
      return junction_end(config);
    case CouplingMode::transmission_line:
      return wave_end(config);
    case CouplingMode::gain_cut:
      return gain_cut_end(config);
    case CouplingMode::passivity_controller:
    case CouplingMode::printed_dead_reckoning:
    case CouplingMode::reckon:
      return model_end(config);
  }
  throw std::invalid_argument("coupling: no such mode");
}

}  // namespace reckon::bench
