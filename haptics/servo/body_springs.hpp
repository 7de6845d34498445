// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The springs between a probe and the bodies that it touches, holds, or may touch soon.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <limits>

#include "reckon/haptics/bodies/body_push.hpp"
#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/contact/grab.hpp"
#include "reckon/haptics/contact/region_share.hpp"
#include "reckon/haptics/contact/wall_contact.hpp"
#include "reckon/haptics/scene/grab_spring.hpp"

namespace reckon::haptics {

/// For maps from the objects of a plan to bodies: not a body.
inline constexpr std::uint32_t kNoBody = std::numeric_limits<std::uint32_t>::max();
/// Periods of look-ahead for approaching bodies.
inline constexpr double kSpringsAhead = 3.0;

/// A spring that a hand may hold a body with, beside the walls of the same stiffness limit.
/// @param mass of the body [kg] @param period [s] @param cap [N/m], of the device's walls
[[nodiscard]] inline GrabSpring held_by(GrabSpring spring, double mass, double period, double cap) {
  constexpr double kSpringShare = 0.5, kViscousShare = 0.1;  // of the body's limits
  spring.stiffness = std::min(
      {spring.stiffness, kGrabOverWalls * cap, kSpringShare * stiffest_push(mass, period)});
  spring.viscosity = std::min(spring.viscosity, kViscousShare * mass / period);
  return spring;
}

/// The spring of a grab. Its probe is not set. @param velocity of the probe [m/s, S]
/// @param pad [m], radius with which it resists rotation
[[nodiscard]] inline BodySpring spring_of(const Grab& grab, const Eigen::Vector3d& velocity,
                                          double pad) noexcept {
  BodySpring spring;
  spring.body = grab.body();
  spring.point = grab.point();
  spring.force = -grab.spring_force();
  spring.normal = Eigen::Vector3d::UnitZ();
  spring.stiffness = grab.stiffness();
  spring.velocity = velocity;
  spring.grips = true;
  spring.viscosity = grab.viscosity();
  spring.drag = grab.viscosity() * (velocity - grab.point_velocity());
  spring.turning = grab.viscosity() * pad * pad;
  return spring;
}

/// Calls visit(index, spring) for each moving object of the plan that the probe touches, and for
/// each that it may touch within a time. The spring's body, probe and patch are not set.
/// @param is_body of an index of the plan @param velocity of the probe [m/s, S]
/// @param soon [s], of look-ahead
void visit_body_springs(const WallContact& walls, const auto& is_body,
                        const Eigen::Vector3d& velocity, double soon, auto&& visit) {
  const auto complete = [&](std::uint32_t index, BodySpring& spring) {
    spring.velocity = velocity;
    spring.stiffness = walls.stiffness_of(index);
    spring.friction = walls.friction_of(index);
    visit(index, spring);
  };
  for (const std::uint32_t index : walls.result().touched) {
    if (!is_body(index)) continue;
    const ObjectContact& contact = walls.result().objects[index];
    BodySpring spring;
    spring.point = contact.scp;
    spring.force = -walls.gain() * contact.force;
    spring.normal = contact.normal;
    complete(index, spring);
  }
  std::size_t next = 0;
  while (const auto near = walls.near_body(next, velocity, soon)) {
    BodySpring spring;
    spring.point = near->point;
    spring.normal = near->normal;
    spring.gap = near->gap;
    complete(near->index, spring);
  }
}

}  // namespace reckon::haptics
