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

/// Mass, damping and grip are as in SimulatedDevice; the grip's far end follows a PointerPath.
/// Until the first sample it rests at the start, or follows a course. If the pointer releases or
/// stalls, the grip fades within 0.3 s, and the path waits at the hand, where the next grip begins.
/// After kAlone without a pointer the course continues.
///
/// The grip is on the operator's side of the port. The servo's ledger books the work of the
/// rendered forces and of the device's own damping on the resulting motion. Work that moves or
/// fades the grip is the operator's (hand_work()) and adds nothing to the ledger.
///
/// Limits, so that no jump of a pointer is a fault of the device: the path moves at most at 0.4 of
/// max_speed. The spring pulls with at most half of max_force, or less if that would move the
/// handle faster than 0.9 of max_speed against the damping of device and grip.
class PointerDevice : public SimulatedDevice {
 public:
  /// Time without a pointer after which a hand follows its course again [s].
  static constexpr double kAlone = 20.0;

  /// @param reach [m] > 0, greatest distance from the start along each axis of the device. @param
  /// course target of the hand without a pointer, frame D; null: it rests at the start until the
  /// first sample. @throws std::invalid_argument for the reach, a grip without damping, or as
  /// SimulatedDevice
  PointerDevice(const SimulatedDeviceConfig& config, double reach, HandScript course = nullptr);
  PointerDevice(const PointerDevice&) = delete;
  PointerDevice& operator=(const PointerDevice&) = delete;

  /// Its workspace is the box within the pointer's reach.
  [[nodiscard]] DeviceLimits limits() const noexcept override;
  [[nodiscard]] DeviceSample read(std::chrono::nanoseconds now) noexcept override;

  [[nodiscard]] PointerInbox& inbox() noexcept { return inbox_; }
  [[nodiscard]] const PointerPath& path() const noexcept { return path_; }
  /// Share of the grip, 0 .. 1.
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
