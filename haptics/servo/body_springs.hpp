// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The springs between a probe and the bodies that it touches, or may touch soon.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>

#include "reckon/haptics/bodies/body_push.hpp"
#include "reckon/haptics/contact/wall_contact.hpp"

namespace reckon::haptics {

/// For maps from the objects of a plan to bodies: not a body.
inline constexpr std::uint32_t kNoBody = std::numeric_limits<std::uint32_t>::max();
/// Periods of look-ahead for approaching bodies.
inline constexpr double kSpringsAhead = 3.0;

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
