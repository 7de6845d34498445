// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/servo/handle_motion.hpp"

#include <algorithm>
#include <cmath>

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;

constexpr double kUnit = 1e-6;        // tolerance of a quaternion's length
constexpr double kTurnMisfit = 1e-4;  // [rad], misfit of the rotation filter

}  // namespace

template <int axes>
HandleMotion<axes>::HandleMotion(const ServoConfig& config, double turn_resolution)
    : origin_(config.device_origin),
      orientation_(config.device_orientation),
      to_scene_(config.device_orientation.toRotationMatrix()),
      turn_motion_(std::max(kTurnMisfit, turn_resolution)) {}

template <int axes>
bool HandleMotion<axes>::is_whole(const DeviceSample& reading) noexcept {
  if constexpr (axes == 3) return true;
  return reading.turn && std::abs(reading.turn->orientation.norm() - 1.0) < kUnit;
}

template <int axes>
HandlePose HandleMotion<axes>::pose_at(const Vector3d& position) const noexcept {
  return {origin_ + to_scene_ * position, Eigen::Quaterniond::Identity()};
}

template <int axes>
HandlePose HandleMotion<axes>::pose_of(const DeviceSample& reading) const noexcept {
  HandlePose pose = pose_at(reading.position);
  if constexpr (axes == 6) pose.orientation = orientation_ * reading.turn->orientation;
  return pose;
}

template <int axes>
std::optional<HandlePose> HandleMotion<axes>::released_at(
    const DeviceSample& reading) const noexcept {
  if (!reading.released_at || !reading.released_at->allFinite()) return std::nullopt;
  HandlePose pose = pose_at(*reading.released_at);
  if constexpr (axes == 6) {
    const auto& orientation = reading.released_turned;
    if (!orientation || !(std::abs(orientation->norm() - 1.0) < kUnit)) return std::nullopt;
    pose.orientation = orientation_ * *orientation;
  }
  return pose;
}

template <int axes>
void HandleMotion<axes>::follow(const DeviceSample& reading, double time,
                                ToolOf<axes>& tool) noexcept {
  const bool measured = reading.has_velocity && reading.velocity.allFinite();
  if constexpr (axes == 3) {
    motion_.add(tool.place(), time);
    tool.set_velocity(measured ? Vector3d(to_scene_ * reading.velocity) : motion_.velocity());
  } else {
    motion_.add(tool.pose().position, time);
    turned_ += tool.step().template tail<3>();
    turn_motion_.add(turned_, time);
    const bool turns = measured && reading.turn->rate.allFinite();
    tool.set_velocity(turns ? Vector3d(to_scene_ * reading.velocity) : motion_.velocity(),
                      turns ? Vector3d(to_scene_ * reading.turn->rate) : turn_motion_.velocity());
  }
}

template class HandleMotion<3>;
template class HandleMotion<6>;

}  // namespace reckon::haptics
