// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A device as its hand moves: scaled, mirrored, and let go of by a clutch.
#pragma once

#include "reckon/haptics/devices/hand_mapping.hpp"
#include "reckon/haptics/devices/haptic_device.hpp"

namespace reckon::haptics {

/// Stands between a servo and a device, and maps what they tell each other so that the force does
/// the same work on both sides.
///
/// Clutch: in the step that sees it go down the way of the handle is still told, for the force of
/// the last sample did its work on it, and so it is while older forces of a device with a delay
/// are under way. From then on the hand stands still. The operator's switch counts as released all
/// the while, so that contacts let go and no force is written. When it is up again the hand goes on
/// from where it stood, and contacts fade in. Turns of the handle are told all the while.
class MappedDevice : public HapticDevice {
 public:
  /// @param device outlives this @throws std::invalid_argument for a scale that is not above 0, or
  /// a button that is none of 0 to 31
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
  Eigen::Vector3d offset_ = Eigen::Vector3d::Zero();  // [m], of the hand, by clutching
  Eigen::Vector3d stands_ = Eigen::Vector3d::Zero();  // [m], of the hand while it stands still
};

}  // namespace reckon::haptics
