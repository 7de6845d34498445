// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The calls of the kernel on event devices.
#pragma once

#include <linux/input.h>

#include <chrono>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace reckon::haptics {

/// Remedy for a user without permission to open a device.
inline constexpr const char* kEventRemedy =
    "sudo reckon devices --install-rule, then plug it in again; or sudo usermod -aG input $USER, "
    "then log in again";

/// Intervals between reports, from a device's USB endpoints; 0: unknown.
struct ReportIntervals {
  std::chrono::microseconds takes{0};  ///< of reports from the host to the device
  std::chrono::microseconds sends{0};  ///< of reports from the device
};

/// Failures return -errno; interrupted calls are repeated. Only strings may throw.
class EventCalls {
 public:
  virtual ~EventCalls() = default;

  /// Paths of the event devices of this host, in order of their numbers.
  [[nodiscard]] virtual std::vector<std::string> paths() = 0;
  /// Name of a force feedback device, without opening it; empty: no such device, or unknown.
  [[nodiscard]] virtual std::string closed_name(const std::string& path) = 0;
  [[nodiscard]] virtual ReportIntervals report_intervals(const std::string& path) = 0;
  /// Remedy for a user without permission to open it.
  [[nodiscard]] virtual std::string denied_remedy(const std::string& /*path*/) {
    return kEventRemedy;
  }
  /// Opens for reading and writing, non-blocking. @return a descriptor
  [[nodiscard]] virtual int open(const std::string& path) = 0;
  virtual void close(int file) noexcept = 0;
  /// A reason beyond the results of control() why it cannot be used, as a sentence; empty: none
  /// known.
  [[nodiscard]] virtual std::string fault(int /*file*/) { return {}; }
  /// Whether control() and write() return only after the device has received the data. Otherwise
  /// the kernel queues it and sends it later.
  [[nodiscard]] virtual bool waits_for_device(int /*file*/) const noexcept { return false; }
  /// ioctl. @return its result
  [[nodiscard]] virtual int control(int file, unsigned long request, void* argument) noexcept = 0;
  /// @return number of events read into `events`; -EAGAIN: none pending
  [[nodiscard]] virtual int read(int file, std::span<input_event> events) noexcept = 0;
  /// @return 0
  [[nodiscard]] virtual int write(int file, const input_event& event) noexcept = 0;
  /// Waits until events are pending, at most `longest`. @param file negative: waits `longest`
  virtual void wait(int file, std::chrono::microseconds longest) noexcept = 0;

 protected:
  EventCalls() = default;
  EventCalls(const EventCalls&) = default;
  EventCalls& operator=(const EventCalls&) = default;
};

/// The calls of the kernel. @param devices folder of event devices @param facts their sysfs folder
[[nodiscard]] std::unique_ptr<EventCalls> kernel_event_calls(
    const std::string& devices = "/dev/input", const std::string& facts = "/sys/class/input");

}  // namespace reckon::haptics
