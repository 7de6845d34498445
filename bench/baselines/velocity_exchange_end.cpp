// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/baselines/velocity_exchange_end.hpp"

namespace reckon::bench {

VelocityExchangeEnd::VelocityExchangeEnd(const CouplingEndConfig& config) noexcept
    : environment_(config.environment),
      direction_(config.side == CouplingSide::first ? 1.0 : -1.0),
      period_(config.period) {}

double VelocityExchangeEnd::step(const OwnMotion& own,
                                 std::span<const CouplingSample> arrived) noexcept {
  ContactLaw law = environment_.at(own.number * period_);
  law.surface = 0.0;  // its motion is included in the depth
  if (own.number == 0) {
    last_position_ = sent_position_ = own.position;
  } else {
    world_work_ += law.energy(depth_) - law_.energy(depth_);
  }
  law_ = law;
  number_ = own.number;
  depth_ += direction_ * (own.position - last_position_ - other_speed_ * period_);
  last_position_ = own.position;
  for (const CouplingSample& sample : arrived) other_speed_ = sample.velocity;
  return -direction_ * law.force(depth_);
}

CouplingSample VelocityExchangeEnd::sample() noexcept {
  CouplingSample out;
  out.number = number_;
  if (number_ > sent_)
    out.velocity = (last_position_ - sent_position_) / ((number_ - sent_) * period_);
  sent_ = number_;
  sent_position_ = last_position_;
  return out;
}

SurfaceSpeedServer::SurfaceSpeedServer(const CouplingEndConfig& config) noexcept
    : environment_(config.environment), period_(config.period) {}

double SurfaceSpeedServer::step(const OwnMotion& own, std::span<const CouplingSample>) noexcept {
  number_ = own.number;
  return 0.0;
}

CouplingSample SurfaceSpeedServer::sample() noexcept {
  CouplingSample out;
  out.number = number_;
  const double surface = environment_.at(number_ * period_).surface;
  if (number_ > sent_) out.velocity = (surface - sent_surface_) / ((number_ - sent_) * period_);
  sent_ = number_;
  sent_surface_ = surface;
  return out;
}

}  // namespace reckon::bench
