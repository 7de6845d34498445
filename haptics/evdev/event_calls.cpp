// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/evdev/event_calls.hpp"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <utility>

#include "reckon/haptics/evdev/kernel_files.hpp"

namespace reckon::haptics {
namespace {

class KernelEventCalls final : public EventCalls {
 public:
  KernelEventCalls(std::string devices, std::string facts)
      : devices_(std::move(devices)), facts_(std::move(facts)) {}

  std::vector<std::string> paths() override { return numbered_files(devices_, "event"); }
  // capabilities/ff lists the effects as hexadecimal words; all zeros: no force feedback.
  std::string closed_name(const std::string& path) override {
    const auto of =
        std::filesystem::path(facts_) / std::filesystem::path(path).filename() / "device";
    const std::string effects = first_line(of / "capabilities" / "ff");
    return effects.find_first_not_of("0 ") == std::string::npos ? "" : first_line(of / "name");
  }
  // input device -> HID device -> USB interface, whose folder lists the endpoints.
  ReportIntervals report_intervals(const std::string& path) override {
    return intervals_of(std::filesystem::path(facts_) / std::filesystem::path(path).filename() /
                        "device" / "device" / "..");
  }
  int open(const std::string& path) override {
    return kernel_call([&] { return ::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC); });
  }
  void close(int file) noexcept override { ::close(file); }
  int control(int file, unsigned long request, void* argument) noexcept override {
    return kernel_call([&] { return ::ioctl(file, request, argument); });
  }
  // The kernel returns whole events only.
  int read(int file, std::span<input_event> events) noexcept override {
    const auto octets =
        kernel_call([&] { return ::read(file, events.data(), events.size_bytes()); });
    if (octets < 0) return static_cast<int>(octets);
    if (octets == 0) return -ENODEV;
    const auto whole = static_cast<std::size_t>(octets);
    return whole % sizeof(input_event) == 0 ? static_cast<int>(whole / sizeof(input_event)) : -EIO;
  }
  int write(int file, const input_event& event) noexcept override {
    const auto octets = kernel_call([&] { return ::write(file, &event, sizeof event); });
    if (octets < 0) return static_cast<int>(octets);
    return octets == sizeof event ? 0 : -EIO;
  }
  void wait(int file, std::chrono::microseconds longest) noexcept override {
    wait_for(file, longest);
  }

 private:
  std::string devices_, facts_;
};

}  // namespace

std::unique_ptr<EventCalls> kernel_event_calls(const std::string& devices,
                                               const std::string& facts) {
  return std::make_unique<KernelEventCalls>(devices, facts);
}

}  // namespace reckon::haptics
