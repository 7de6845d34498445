// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Converts readings of a device to the motion of its handle in the scene.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>

#include "reckon/haptics/contact/tool.hpp"
#include "reckon/haptics/devices/haptic_device.hpp"
#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/haptics/servo/motion_filter.hpp"

namespace reckon::haptics {

/// For a device with `axes` axes, 3 or 6. Servo thread.
template <int axes>
class HandleMotion {
 public:
  /// @param turn_resolution [rad]
  HandleMotion(const ServoConfig& config, double turn_resolution);

  /// Rotation from the device's axes to the scene.
  [[nodiscard]] const Eigen::Matrix3d& axes_in_scene() const noexcept { return to_scene_; }
  /// Whether a reading is complete: with an orientation for a device of 6 axes.
  [[nodiscard]] static bool is_whole(const DeviceSample& reading) noexcept;
  /// @param reading is_whole()
  [[nodiscard]] HandlePose pose_of(const DeviceSample& reading) const noexcept;
  /// Pose at which the device dropped its force; std::nullopt: unknown.
  [[nodiscard]] std::optional<HandlePose> released_at(const DeviceSample& reading) const noexcept;
  /// Sets the velocity of the tool, which has moved to this reading: measured, or filtered.
  /// @param time of the step [s]
  void follow(const DeviceSample& reading, double time, ToolOf<axes>& tool) noexcept;
  /// Filtered acceleration of the handle [m/s^2], S.
  [[nodiscard]] Eigen::Vector3d acceleration() const noexcept { return motion_.acceleration(); }

 private:
  [[nodiscard]] HandlePose pose_at(const Eigen::Vector3d& position) const noexcept;

  Eigen::Vector3d origin_;
  Eigen::Quaterniond orientation_;
  Eigen::Matrix3d to_scene_;
  MotionFilter motion_;
  MotionFilter turn_motion_;                          // for a device of 6 axes
  Eigen::Vector3d turned_ = Eigen::Vector3d::Zero();  // [rad], sum of all rotations
};

}  // namespace reckon::haptics
