// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The servo's view of a device on USB.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "reckon/haptics/devices/haptic_device.hpp"
#include "reckon/haptics/usb/usb_exchange.hpp"

namespace reckon::haptics {

/// Reads and writes are atomics and copies: no lock, no allocation, no system call. The device
/// belongs to the thread of UsbLoop.
///
/// Its delay is fixed, though the device is not synchronous with the servo. A force waits for one
/// exchange at most, is held for one, and the report that ends it arrives after a third. Each
/// report has the numbers of the writes before and after its instant. A read returns the last
/// report before which only forces at least `delay` writes old were held, so the ledger books each
/// motion under the force that was held. If that report has not arrived, or the device is gone, the
/// reading fails.
///
/// If the friction of the joints is known (`lever` of the limits), a reading states the damping at
/// the worst pose of all later reports, with a margin of a tenth of the lever. The driver receives
/// that lever and limits its torques to what this damping covers, at any pose.
class UsbDevice final : public HapticDevice {
 public:
  /// @param exchange outlives it  @param limits see usb_limits()
  UsbDevice(UsbExchange& exchange, const DeviceLimits& limits);

  [[nodiscard]] DeviceLimits limits() const noexcept override { return limits_; }
  [[nodiscard]] DeviceSample read(std::chrono::nanoseconds now) noexcept override;
  void write(const Eigen::Vector3d& force, std::chrono::nanoseconds now) noexcept override;

  /// The least `delay` [writes] with which no valid reading so far would have failed; 0: no reading
  /// yet. It measures host and line without a force. The servo's thread, or any after that has
  /// ended.
  [[nodiscard]] int needed_delay() const noexcept { return needed_; }
  /// Whether the report of the last read has a timestamp of the device's clock. The servo's thread.
  [[nodiscard]] bool has_clock() const noexcept { return shown_.at.has_value(); }
  /// When the host received the report of the last read, on the clock of the writes. The servo's
  /// thread.
  [[nodiscard]] std::chrono::nanoseconds heard() const noexcept { return shown_.heard; }

 private:
  void take_readings() noexcept;
  void forget_readings() noexcept;
  void note_pose(DeviceSample& sample) noexcept;
  [[nodiscard]] bool is_over(std::chrono::nanoseconds now) const noexcept;
  // Time from the write that is `delay` old to the next one; std::nullopt: no such write.
  [[nodiscard]] std::optional<std::chrono::nanoseconds> held_for() const noexcept;

  UsbExchange& exchange_;
  DeviceLimits limits_;
  std::int64_t written_ = 0;
  std::chrono::nanoseconds written_at_{0};             // of the last write
  std::vector<std::chrono::nanoseconds> write_times_;  // ring buffer of the last delay + 2
  // Readings not shown yet, a ring buffer.
  std::array<UsbReading, 2 * UsbExchange::kReadings> waiting_{};
  std::size_t first_ = 0, count_ = 0;
  UsbReading shown_;
  std::optional<std::chrono::nanoseconds>
      told_at_;  // device's time of this run's last sample, if any
  std::uint32_t run_ = 0;
  bool has_shown_ = false;  // a reading of this run has been shown
  bool dropped_ = false;    // the force was dropped, not yet reported to the servo
  double held_ = 1.0;       // least share held since the last valid reading
  double lever_ =
      std::numeric_limits<double>::infinity();  // [m/rad] of the damping last reported, with margin
  int needed_ = 0;                              // [writes], see needed_delay()
};

}  // namespace reckon::haptics
