// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A simulated device whose operator is a pointer: a mouse, a finger on a screen, keys.
#pragma once

#include <chrono>

#include "reckon/haptics/devices/pointer_grip.hpp"
#include "reckon/haptics/devices/pointer_inbox.hpp"
#include "reckon/haptics/devices/pointer_path.hpp"
#include "reckon/haptics/devices/simulated_device.hpp"

namespace reckon::haptics {

/// Mass, damping and grip are those of any simulated device; the grip's far end goes the way of a
/// PointerPath. Until the first sample it rests at the start, or goes a course. Where the pointer
/// lets go or stalls, the grip fades within 0.3 s and the path waits where the hand is, so that
/// whoever takes it again begins there. After kAlone without a pointer the course goes on.
///
/// The grip stands on the operator's side of the port. The servo's ledger books the work of the
/// forces that it renders, and the device's own damping, with the motion that comes of it; whatever
/// moves or fades the grip is the operator's work (hand_work()) and gives the ledger nothing.
///
/// What a hand does at most, so that no jump of a pointer is a fault of the device: the path goes
/// at 0.4 of max_speed, and the spring pulls with half of max_force, less where that would move the
/// handle at more than 0.9 of max_speed against the damping of device and grip.
class PointerDevice : public SimulatedDevice {
 public:
  /// Without a pointer for so long [s] a hand goes its course again.
  static constexpr double kAlone = 20.0;

  /// @param reach [m] > 0: so far from the start the pointer takes it, along each axis of the
  /// device. @param course where the hand wants to be while nobody points, frame D; null: it rests
  /// at the start and is never taken again. @throws std::invalid_argument for the reach, or a grip
  /// without damping, or as SimulatedDevice
  PointerDevice(const SimulatedDeviceConfig& config, double reach, HandScript course = nullptr);
  PointerDevice(const PointerDevice&) = delete;
  PointerDevice& operator=(const PointerDevice&) = delete;

  /// Its workspace is the box that the pointer reaches.
  [[nodiscard]] DeviceLimits limits() const noexcept override;
  [[nodiscard]] DeviceSample read(std::chrono::nanoseconds now) noexcept override;

  [[nodiscard]] PointerInbox& inbox() noexcept { return inbox_; }
  [[nodiscard]] const PointerPath& path() const noexcept { return path_; }
  /// Share of the grip that holds, 0 .. 1.
  [[nodiscard]] double grip() const noexcept { return grip_.share(); }
  /// Largest pull of the grip's spring [N].
  [[nodiscard]] double most_pull() const noexcept { return most_pull_; }

 private:
  [[nodiscard]] HandTarget target_at(double time) noexcept;
  void lead() noexcept;

  HandScript course_;
  PointerInbox inbox_;
  PointerPath path_;
  PointerGrip grip_;
  double most_pull_;
  double time_ = 0.0;  // [s], of path and grip
};

}  // namespace reckon::haptics
