// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Scenes for a device of six axes.
#pragma once

#include <Eigen/Geometry>
#include <stdexcept>

#include "reckon/haptics/contact/tool.hpp"
#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/haptics/scene/effect_plan.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"

namespace reckon::haptics::turning {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

inline constexpr nanoseconds kPeriod = milliseconds(1);

inline Quaterniond turn(double angle, const Vector3d& axis) {
  return Quaterniond(Eigen::AngleAxisd(angle, axis.normalized()));
}

inline SceneObject floor_at(double height, double stiffness) {
  SceneObject object;
  object.shape = PlaneShape{Vector3d::UnitZ()};
  object.pose.position = {0, 0, height};
  object.effects.of<SpringDamper>() = {stiffness, 0.0};
  return object;
}

}  // namespace reckon::haptics::turning
