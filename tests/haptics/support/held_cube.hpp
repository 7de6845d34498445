// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A cube held by hands.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"

namespace reckon::haptics::grabbed {

using Eigen::Vector3d;
using std::chrono::nanoseconds;

inline constexpr double kT = 1e-3;
inline constexpr double kHalf = 0.02;  // [m], of the cube
inline constexpr double kWall = 300.0;

inline Scene cube_of(double mass, const Vector3d& gravity = Vector3d::Zero()) {
  Scene scene;
  scene.gravity = gravity;
  SceneObject& cube = scene.objects.emplace_back();
  cube.name = "cube";
  cube.shape = BoxShape{Vector3d::Constant(2 * kHalf)};
  cube.effects.of<SpringDamper>() = {std::min(kWall, stiffest_push(mass, kT)), 0.0};
  cube.matter.mass = mass;
  return scene;
}

inline SimulatedDeviceConfig device_at(const Vector3d& start) {
  SimulatedDeviceConfig config;
  config.damping = 3.0;
  config.hand_stiffness = 300;
  config.hand_damping = 3;
  config.max_force = 30;
  config.max_speed = 5;
  config.start = start;
  return config;
}

inline ServoConfig holding(double stiffness, double viscosity) {
  ServoConfig config;
  config.grab = {stiffness, viscosity};
  return config;
}

}  // namespace reckon::haptics::grabbed
