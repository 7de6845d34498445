// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/bodies/near_bodies.hpp"

#include <limits>

#include "reckon/haptics/bodies/body_world.hpp"

namespace reckon::haptics {
namespace {

constexpr double kMargin = 0.005;  // [m], of a hand that starts from rest

}  // namespace

std::size_t NearBodies::add_hand() {
  hands_.emplace_back().bodies.reserve(radius_.size());
  return hands_.size() - 1;
}

void NearBodies::foresee(std::span<const BodyState> states, double period) noexcept {
  for (Hand& hand : hands_) list(hand, states, period);
  is_foreseen_ = true;
}

void NearBodies::list(Hand& hand, std::span<const BodyState> states, double period) const noexcept {
  const double time = kAhead * period;
  hand.covers = hand.at.radius + kMargin + hand.at.speed * time;
  hand.bodies.clear();
  for (std::uint32_t i = 0; i < states.size(); ++i) {
    const double reach = hand.covers + radius_[i] + states[i].velocity.norm() * time;
    if ((states[i].position - hand.at.middle).squaredNorm() <= reach * reach)
      hand.bodies.push_back(i);
  }
}

std::span<const std::uint32_t> NearBodies::of(std::size_t hand, const HandReach& reach,
                                              std::span<const BodyState> states,
                                              double period) noexcept {
  Hand& own = hands_[hand];
  const double moved = (reach.middle - own.at.middle).norm();
  const double needed = moved + reach.radius + reach.speed * (kAhead - 1.0) * period;
  if (!is_foreseen_ || !(needed <= own.covers)) {
    own.at = reach;
    list(own, states, period);
  }
  return own.bodies;
}

std::vector<double> radii_of_moving(const EffectPlan& plan) {
  std::vector<double> out;
  for (const PlannedObject& object : plan.objects()) {
    if (!object.moves()) continue;
    const Eigen::Vector3d least = object.bounds.min() - object.position;
    const Eigen::Vector3d most = object.bounds.max() - object.position;
    const double radius = least.cwiseAbs().cwiseMax(most.cwiseAbs()).norm();
    const bool is_always = object.carried || object.acts_from_afar();
    out.push_back(is_always ? std::numeric_limits<double>::infinity() : radius);
  }
  return out;
}

}  // namespace reckon::haptics
