// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/baselines/effort_flow_end.hpp"

namespace reckon::bench {

double FlowEnd::step(const OwnMotion& own, std::span<const CouplingSample> arrived) noexcept {
  own_ = own;
  for (const CouplingSample& sample : arrived) effort_ = sample.effort;
  return -effort_;
}

CouplingSample FlowEnd::sample() noexcept {
  CouplingSample out;
  out.number = own_.number;
  out.position = own_.position;
  out.velocity = own_.velocity;
  return out;
}

EffortEnd::EffortEnd(const CouplingEndConfig& config) noexcept
    : environment_(config.environment),
      gain_(config.mode == CouplingMode::gain_cut ? config.gain : 1.0),
      period_(config.period) {}

double EffortEnd::step(const OwnMotion& own, std::span<const CouplingSample> arrived) noexcept {
  const ContactLaw law = environment_.at(own.number * period_);
  const double depth = seen_ - own.position;
  if (own.number > 0) world_work_ += gain_ * (law.energy(depth) - law_.energy(depth));
  law_ = law;
  number_ = own.number;
  for (const CouplingSample& sample : arrived) seen_ = sample.position;
  effort_ = gain_ * law.force(seen_ - own.position);
  return effort_;
}

CouplingSample EffortEnd::sample() noexcept {
  CouplingSample out;
  out.number = number_;
  out.effort = effort_;
  return out;
}

}  // namespace reckon::bench
