// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/baselines/local_model_end.hpp"

#include <algorithm>

namespace reckon::bench {

LocalModelEnd::LocalModelEnd(const CouplingEndConfig& config, double share,
                             bool extrapolates) noexcept
    : direction_(config.side == CouplingSide::first ? 1.0 : -1.0),
      period_(config.period),
      share_(share),
      stiffness_(config.environment.stiffness()),
      extrapolates_(extrapolates) {}

double LocalModelEnd::step(const OwnMotion& own, std::span<const CouplingSample> arrived) noexcept {
  own_ = own;
  for (const CouplingSample& sample : arrived) model_ = sample;
  const double age = (static_cast<double>(own.number) - model_.number) * period_;
  const double surface = model_.position + (extrapolates_ ? model_.velocity * age : 0.0);
  const double depth = std::max(0.0, direction_ * (own.position - surface));
  return -direction_ * share_ * model_.stiffness * depth;
}

CouplingSample LocalModelEnd::sample() noexcept {
  CouplingSample out;
  out.number = own_.number;
  out.position = own_.position;
  out.velocity = own_.velocity;
  out.stiffness = stiffness_;
  return out;
}

PassivityControllerEnd::PassivityControllerEnd(const CouplingEndConfig& config) noexcept
    : LocalModelEnd(config, 1.0, true),
      period_(config.period),
      most_damping_(config.mass / config.period) {}

double PassivityControllerEnd::step(const OwnMotion& own,
                                    std::span<const CouplingSample> arrived) noexcept {
  const double dx = started_ ? own.position - last_position_ : 0.0;
  started_ = true;
  last_position_ = own.position;
  observed_ -= held_ * dx;
  held_ = LocalModelEnd::step(own, arrived);

  // The damper dissipates, in the next sample at this speed, as much energy as brings the balance
  // to 0.
  const double square = dx * dx / period_;
  if (observed_ < 0 && square > 0)
    held_ -= std::min(most_damping_, -observed_ / square) * dx / period_;
  return held_;
}

TangentServer::TangentServer(const CouplingEndConfig& config) noexcept
    : environment_(config.environment), period_(config.period) {}

double TangentServer::step(const OwnMotion& own, std::span<const CouplingSample> arrived) noexcept {
  number_ = own.number;
  for (const CouplingSample& sample : arrived) seen_ = sample.position;
  return 0.0;
}

CouplingSample TangentServer::sample() noexcept {
  const Tangent now = environment_.at(number_ * period_).tangent(seen_);
  CouplingSample out;
  out.number = number_;
  out.position = now.surface;
  out.stiffness = now.stiffness;
  return out;
}

}  // namespace reckon::bench
