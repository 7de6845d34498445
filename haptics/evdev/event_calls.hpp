// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The few calls of the kernel by which event devices are used.
#pragma once

#include <linux/input.h>

#include <chrono>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace reckon::haptics {

/// For a user who may not open a device.
inline constexpr const char* kEventRemedy =
    "sudo reckon devices --install-rule, and plug it in again; or sudo usermod -aG input $USER, "
    "and log in again";

/// Between two reports, by a device's USB endpoints; 0: unknown.
struct ReportIntervals {
  std::chrono::microseconds takes{0};  ///< that it takes of this host
  std::chrono::microseconds sends{0};  ///< that it sends
};

/// What fails returns -errno; an interrupted call is made again. Nothing throws but where strings
/// do.
class EventCalls {
 public:
  virtual ~EventCalls() = default;

  /// Event devices of this host, by their numbers.
  [[nodiscard]] virtual std::vector<std::string> paths() = 0;
  /// Name of a device that gives force feedback, without opening it; empty: another, or unknown.
  [[nodiscard]] virtual std::string closed_name(const std::string& path) = 0;
  [[nodiscard]] virtual ReportIntervals report_intervals(const std::string& path) = 0;
  /// For a user who may not open it.
  [[nodiscard]] virtual std::string denied_remedy(const std::string& /*path*/) {
    return kEventRemedy;
  }
  /// For reading and writing, without waiting. @return a descriptor
  [[nodiscard]] virtual int open(const std::string& path) = 0;
  virtual void close(int file) noexcept = 0;
  /// Why it cannot be used, beyond what control() tells of it, as a sentence; empty: nothing is
  /// known.
  [[nodiscard]] virtual std::string fault(int /*file*/) { return {}; }
  /// Whether the device has what it is told when control() or write() returns; else the kernel has,
  /// which sends it by and by.
  [[nodiscard]] virtual bool waits_for_device(int /*file*/) const noexcept { return false; }
  /// ioctl. @return its result
  [[nodiscard]] virtual int control(int file, unsigned long request, void* argument) noexcept = 0;
  /// @return events that were read, the first of `events`; -EAGAIN: there are none
  [[nodiscard]] virtual int read(int file, std::span<input_event> events) noexcept = 0;
  /// @return 0
  [[nodiscard]] virtual int write(int file, const input_event& event) noexcept = 0;
  /// Waits for events so long at most. @param file negative: of none
  virtual void wait(int file, std::chrono::microseconds longest) noexcept = 0;

 protected:
  EventCalls() = default;
  EventCalls(const EventCalls&) = default;
  EventCalls& operator=(const EventCalls&) = default;
};

/// Those of the kernel. @param devices folder of event devices @param facts folder that tells of
/// each what it is
[[nodiscard]] std::unique_ptr<EventCalls> kernel_event_calls(
    const std::string& devices = "/dev/input", const std::string& facts = "/sys/class/input");

}  // namespace reckon::haptics
