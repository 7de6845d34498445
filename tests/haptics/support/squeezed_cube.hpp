// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A cube between two hands that squeeze it.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"

namespace reckon::haptics::squeezed {

using Eigen::Vector3d;
using std::chrono::nanoseconds;

inline constexpr double kT = 1e-3;
inline constexpr double kHalf = 0.02;  // [m], of the cube

inline double ease(double t) {
  return t <= 0 ? 0 : t >= 1 ? 1 : 0.5 - 0.5 * std::cos(std::numbers::pi * t);
}

/// Goal of hand 0, at the left, or 1: they close in, squeeze, and carry to and fro.
inline double target(int side, double t) {
  const double way = side == 1 ? 1 : -1;
  const double carry = t > 4 && t < 8 ? 0.02 * std::sin(2 * std::numbers::pi * 1.5 * (t - 4)) : 0;
  return way * (0.03 - 0.01 * ease(t / 0.2)) - way * 0.015 * ease((t - 0.2) / 0.8) + carry;
}
inline HandTarget hand_at(int side, double t) {
  HandTarget out;
  out.position.x() = target(side, t);
  out.velocity.x() = (target(side, t + 1e-4) - target(side, t - 1e-4)) / 2e-4;
  return out;
}

inline Scene cube_of(double mass, double stiffness) {
  Scene scene;
  scene.gravity.setZero();
  SceneObject& cube = scene.objects.emplace_back();
  cube.name = "cube";
  cube.shape = BoxShape{Vector3d::Constant(2 * kHalf)};
  cube.effects.of<SpringDamper>() = {stiffness, 0.0};
  cube.matter.mass = mass;
  return scene;
}

inline SimulatedDeviceConfig device_at(const Vector3d& start) {
  SimulatedDeviceConfig config;
  config.mass = 0.1;
  config.damping = 1.0;
  config.hand_stiffness = 300;
  config.hand_damping = 3;
  config.max_force = 30;
  config.max_speed = 5;
  config.start = start;
  return config;
}

}  // namespace reckon::haptics::squeezed
