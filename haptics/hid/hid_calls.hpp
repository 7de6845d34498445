// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The calls of the kernel (linux/hidraw.h) that exchange reports with a device.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "reckon/haptics/evdev/event_calls.hpp"

namespace reckon::haptics {

/// What sysfs states about a device, which need not be open.
struct HidSeen {
  std::string name;                      ///< product name
  std::vector<std::uint8_t> descriptor;  ///< report descriptor; empty: unreadable
  bool kernel_has_springs = false;       ///< its event device renders them (FF_SPRING)
  std::uint16_t vendor = 0, product = 0;
};

/// Failures return -errno; interrupted calls are repeated. Reports begin with their ID.
class HidCalls {
 public:
  virtual ~HidCalls() = default;

  /// Paths of the hidraw devices of this host, in order of their numbers.
  [[nodiscard]] virtual std::vector<std::string> paths() = 0;
  [[nodiscard]] virtual HidSeen look(const std::string& path) = 0;
  [[nodiscard]] virtual ReportIntervals report_intervals(const std::string& path) = 0;
  /// Opens a device. Reads do not block; a write blocks until the device has the report.
  /// @return a descriptor
  [[nodiscard]] virtual int open(const std::string& path) = 0;
  virtual void close(int file) noexcept = 0;
  /// @return 0; -EBUSY: another program has taken it (flock)
  [[nodiscard]] virtual int take(int file) noexcept = 0;
  [[nodiscard]] virtual bool is_there(int file) noexcept = 0;
  /// Reads an input report. @return its octets; -EAGAIN: none pending
  [[nodiscard]] virtual int read(int file, std::span<std::uint8_t> report) noexcept = 0;
  /// Sends an output report. @return 0
  [[nodiscard]] virtual int write(int file, std::span<const std::uint8_t> report) noexcept = 0;
  /// @return 0
  [[nodiscard]] virtual int set_feature(int file,
                                        std::span<const std::uint8_t> report) noexcept = 0;
  /// Reads the feature report, or the present input report, whose ID is in the first octet.
  /// @return octets
  [[nodiscard]] virtual int get_feature(int file, std::span<std::uint8_t> report) noexcept = 0;
  [[nodiscard]] virtual int get_input(int file, std::span<std::uint8_t> report) noexcept = 0;
  /// Waits until a report is pending, at most `longest`.
  virtual void wait(int file, std::chrono::microseconds longest) noexcept = 0;

 protected:
  HidCalls() = default;
  HidCalls(const HidCalls&) = default;
  HidCalls& operator=(const HidCalls&) = default;
};

/// The calls of the kernel. @param devices folder of the device files @param facts their sysfs
/// folder
[[nodiscard]] std::unique_ptr<HidCalls> kernel_hid_calls(
    const std::string& devices = "/dev", const std::string& facts = "/sys/class/hidraw");

}  // namespace reckon::haptics
