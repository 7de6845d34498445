// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/contact/patch_blend.hpp"

#include <algorithm>
#include <cmath>

namespace reckon::haptics {
namespace {

// Distance at which the goal counts as reached, so that no number becomes subnormal.
constexpr double kThere = 1e-12;

// The share `take` of the difference, limited to `most` in either direction.
double step_towards(double from, double to, double take, double most) {
  const double way = to - from;
  const double part = std::abs(way) < kThere ? way : take * way;
  return std::clamp(part, -most, most);
}

double lag(double from, double to, double take) {
  return std::abs(to - from) < kThere ? to : from + take * (to - from);
}

}  // namespace

double PatchBlend::follow(const SurfaceFeel& goal, double depth, double dt,
                          double energy) noexcept {
  const double take = std::min(1.0, dt / kLag);
  const double most = kForceRate * dt;
  lagged_.surface.stiffness = lag(lagged_.surface.stiffness, goal.surface.stiffness, take);
  lagged_.surface.damping = lag(lagged_.surface.damping, goal.surface.damping, take);
  Friction& held = lagged_.friction;
  held.static_coefficient = lag(held.static_coefficient, goal.friction.static_coefficient, take);
  held.kinetic_coefficient = lag(held.kinetic_coefficient, goal.friction.kinetic_coefficient, take);

  // An unstretched spring may change at once: the bounds are infinite there.
  double& stiffness = now_.surface.stiffness;
  const double per_stiffness = 0.5 * depth * depth;  // [J m/N]
  const double wanted = step_towards(stiffness, lagged_.surface.stiffness, take, most / depth);
  const double step = per_stiffness > 0 ? std::min(wanted, energy / per_stiffness) : wanted;
  const double asked = std::max(goal.surface.stiffness, stiffness + wanted);
  share_ = step < wanted ? (stiffness + step) / asked : 1.0;
  stiffness += step;
  now_.surface.damping = lag(now_.surface.damping, lagged_.surface.damping, take);

  Friction& friction = now_.friction;
  const double most_friction = most / (stiffness * depth);
  friction.static_coefficient +=
      step_towards(friction.static_coefficient, held.static_coefficient, take, most_friction);
  friction.kinetic_coefficient +=
      step_towards(friction.kinetic_coefficient, held.kinetic_coefficient, take, most_friction);
  friction.kinetic_coefficient =
      std::min(friction.kinetic_coefficient, friction.static_coefficient);
  return step * per_stiffness;
}

}  // namespace reckon::haptics
