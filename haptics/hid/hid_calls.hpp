// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The few calls of the kernel (linux/hidraw.h) by which reports reach a device and come from it.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "reckon/haptics/evdev/event_calls.hpp"

namespace reckon::haptics {

/// What the kernel tells of a device that is not open.
struct HidSeen {
  std::string name;                      ///< of the product
  std::vector<std::uint8_t> descriptor;  ///< of its reports; empty: unknown
  bool kernel_has_springs = false;       ///< its event device renders them (FF_SPRING)
  std::uint16_t vendor = 0, product = 0;
};

/// What fails returns -errno; an interrupted call is made again. Reports begin with their number.
class HidCalls {
 public:
  virtual ~HidCalls() = default;

  /// Devices of the class HID of this host, by their numbers.
  [[nodiscard]] virtual std::vector<std::string> paths() = 0;
  [[nodiscard]] virtual HidSeen look(const std::string& path) = 0;
  [[nodiscard]] virtual ReportIntervals report_intervals(const std::string& path) = 0;
  /// For reading, without waiting, and writing, which waits until the device has the report.
  /// @return a descriptor
  [[nodiscard]] virtual int open(const std::string& path) = 0;
  virtual void close(int file) noexcept = 0;
  /// @return 0; -EBUSY: another program has it, which also asked
  [[nodiscard]] virtual int take(int file) noexcept = 0;
  [[nodiscard]] virtual bool is_there(int file) noexcept = 0;
  /// An input report. @return its octets; -EAGAIN: there is none
  [[nodiscard]] virtual int read(int file, std::span<std::uint8_t> report) noexcept = 0;
  /// An output report. @return 0
  [[nodiscard]] virtual int write(int file, std::span<const std::uint8_t> report) noexcept = 0;
  /// @return 0
  [[nodiscard]] virtual int set_feature(int file,
                                        std::span<const std::uint8_t> report) noexcept = 0;
  /// The feature report, or the input report as it is now, of the number in its first octet.
  /// @return octets
  [[nodiscard]] virtual int get_feature(int file, std::span<std::uint8_t> report) noexcept = 0;
  [[nodiscard]] virtual int get_input(int file, std::span<std::uint8_t> report) noexcept = 0;
  /// Waits for a report so long at most.
  virtual void wait(int file, std::chrono::microseconds longest) noexcept = 0;

 protected:
  HidCalls() = default;
  HidCalls(const HidCalls&) = default;
  HidCalls& operator=(const HidCalls&) = default;
};

/// Those of the kernel. @param devices folder of them @param facts folder that tells of each
[[nodiscard]] std::unique_ptr<HidCalls> kernel_hid_calls(
    const std::string& devices = "/dev", const std::string& facts = "/sys/class/hidraw");

}  // namespace reckon::haptics
