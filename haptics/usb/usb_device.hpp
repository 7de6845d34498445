// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A device on USB as the servo sees it.
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

/// Reads and writes are atomics and copies: no lock, no allocation, no system call. Another thread
/// (UsbLoop) has the device.
///
/// Its delay is fixed, though the device is not in step with the servo. A force waits for one
/// exchange at most, is held for one, and the report that ends it comes after a third. Each report
/// tells which writes it stands between. A read shows the last report before which only forces were
/// held that are `delay` writes old, so that the ledger books each way of the handle under the very
/// force that was held. Where that report has not come, or the device is gone, the reading fails.
///
/// Where the friction of the joints is what is sure (`lever` of the limits), a reading tells the
/// damping of the worst pose of all reports since, and of one a little worse. The driver is told
/// how much torque that pays for, wherever the handle will be.
class UsbDevice final : public HapticDevice {
 public:
  /// @param exchange outlives it  @param limits see usb_limits()
  UsbDevice(UsbExchange& exchange, const DeviceLimits& limits);

  [[nodiscard]] DeviceLimits limits() const noexcept override { return limits_; }
  [[nodiscard]] DeviceSample read(std::chrono::nanoseconds now) noexcept override;
  void write(const Eigen::Vector3d& force, std::chrono::nanoseconds now) noexcept override;

  /// The least `delay` [writes] with which none of the readings that were good so far would have
  /// failed; 0: there was none. What this host and this line need, found without a force. The
  /// servo's thread, or any once that has ended.
  [[nodiscard]] int needed_delay() const noexcept { return needed_; }
  /// Whether the report that the last read showed has a time of the device's own. The servo's
  /// thread.
  [[nodiscard]] bool has_clock() const noexcept { return shown_.at.has_value(); }
  /// When the host had the report that the last read showed, on the clock of the writes. The
  /// servo's thread.
  [[nodiscard]] std::chrono::nanoseconds heard() const noexcept { return shown_.heard; }

 private:
  void take_readings() noexcept;
  void forget_readings() noexcept;
  void note_pose(DeviceSample& sample) noexcept;
  [[nodiscard]] bool is_over(std::chrono::nanoseconds now) const noexcept;
  // How long the servo had given the write that is `delay` old, if there is one.
  [[nodiscard]] std::optional<std::chrono::nanoseconds> held_for() const noexcept;

  UsbExchange& exchange_;
  DeviceLimits limits_;
  std::int64_t written_ = 0;
  std::chrono::nanoseconds written_at_{0};             // last
  std::vector<std::chrono::nanoseconds> write_times_;  // a ring of the last delay + 2
  // Those not shown yet, a ring.
  std::array<UsbReading, 2 * UsbExchange::kReadings> waiting_{};
  std::size_t first_ = 0, count_ = 0;
  UsbReading shown_;
  std::optional<std::chrono::nanoseconds>
      told_at_;  // of the last sample of this run, if it has one
  std::uint32_t run_ = 0;
  bool has_shown_ = false;  // a reading of this run
  bool dropped_ = false;    // the force was, and the servo does not know
  double held_ = 1.0;       // least share of those since the last good reading
  double lever_ = std::numeric_limits<double>::infinity();  // [m/rad], that is paid for
  int needed_ = 0;                                          // writes, that a delay has to be
};

}  // namespace reckon::haptics
