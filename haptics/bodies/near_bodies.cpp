// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/bodies/near_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "reckon/haptics/bodies/body_world.hpp"

namespace reckon::haptics {

using Eigen::Vector3d;

NearBodies::NearBodies(std::vector<double> radius) : radius_(std::move(radius)) {
  for (std::uint32_t i = 0; i < radius_.size(); ++i)
    if (std::isinf(radius_[i])) always_.push_back(i);
}

std::size_t NearBodies::add_hand() {
  hands_.emplace_back().bodies.reserve(radius_.size());
  return hands_.size() - 1;
}

void NearBodies::foresee(const BodiesAbout& bodies, double period) noexcept {
  for (Hand& hand : hands_) list(hand, hand.watched, bodies, period);
  is_foreseen_ = true;
}

void NearBodies::list(Hand& hand, const HandReach& at, const BodiesAbout& bodies,
                      double period) const noexcept {
  hand.at = at;
  const double time = kAhead * period;
  hand.covers = hand.at.radius + kMargin + hand.at.speed * time;
  std::vector<std::uint32_t>& out = hand.bodies;
  out.assign(always_.begin(), always_.end());
  for (const std::uint32_t i : bodies.awake) {
    const BodyState& state = bodies.states[i];
    const double reach = hand.covers + radius_[i] + state.velocity.norm() * time;
    const bool is_near =
        state.carried || (state.position - hand.at.middle).squaredNorm() <= reach * reach;
    if (is_near && !std::isinf(radius_[i])) out.push_back(i);
  }
  const Vector3d about = Vector3d::Constant(hand.covers);
  bodies.asleep.visit({hand.at.middle - about, hand.at.middle + about}, [&](std::uint32_t i) {
    if (!std::isinf(radius_[i])) out.push_back(i);
  });
  std::ranges::sort(out);
}

std::vector<double> radii_of_moving(const EffectPlan& plan) {
  std::vector<double> out;
  for (const PlannedObject& object : plan.objects()) {
    if (!object.moves()) continue;
    const Vector3d least = object.bounds.min() - object.position;
    const Vector3d most = object.bounds.max() - object.position;
    const double radius = least.cwiseAbs().cwiseMax(most.cwiseAbs()).norm();
    const bool is_always = !object.is_body() || object.acts_from_afar();
    out.push_back(is_always ? std::numeric_limits<double>::infinity() : radius);
  }
  return out;
}

}  // namespace reckon::haptics
