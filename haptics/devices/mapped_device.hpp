// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A device in the hand's frame: scaled, mirrored, and disengaged by a clutch.
#pragma once

#include "reckon/haptics/devices/hand_mapping.hpp"
#include "reckon/haptics/devices/haptic_device.hpp"

namespace reckon::haptics {

/// Adapter between a servo and a device. Maps readings and forces so that the force does the same
/// work on both sides.
///
/// Clutch: when it goes down, the motion of the handle still counts in that step, because the last
/// force has worked on it, and in a device with a delay as long as older forces are pending. Then
/// the hand stops. While the clutch is down, the operator's switch counts as released, so contacts
/// release and no force is written. When it goes up, the hand continues from there, and contacts
/// fade in. Rotations of the handle always count.
class MappedDevice : public HapticDevice {
 public:
  /// @param device outlives this @throws std::invalid_argument if the scale is not above 0, or the
  /// button not in 0 to 31
  MappedDevice(HapticDevice& device, const HandMapping& mapping);

  [[nodiscard]] DeviceLimits limits() const noexcept override;
  [[nodiscard]] DeviceSample read(std::chrono::nanoseconds now) noexcept override;
  void write(const Eigen::Vector3d& force, std::chrono::nanoseconds now) noexcept override;
  void write_wrench(const Eigen::Vector3d& force, const Eigen::Vector3d& torque,
                    std::chrono::nanoseconds now) noexcept override;

 private:
  void map(DeviceSample& sample) const noexcept;
  void engage(DeviceSample& sample) noexcept;
  [[nodiscard]] bool is_clutched(const DeviceSample& sample) const noexcept;
  [[nodiscard]] Eigen::Vector3d to_device(const Eigen::Vector3d& force) const noexcept;

  HapticDevice& device_;
  HandMapping mapping_;
  int delay_;                                         // samples
  int clutched_ = 0;                                  // samples, at most delay_ + 1
  Eigen::Vector3d offset_ = Eigen::Vector3d::Zero();  // [m], offset of the hand from clutching
  Eigen::Vector3d stands_ =
      Eigen::Vector3d::Zero();  // [m], position of the hand while it is stopped
};

}  // namespace reckon::haptics
