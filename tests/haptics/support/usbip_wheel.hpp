// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A PidWheel on the USB of this very kernel: vhci_hcd has one end of a pair of sockets, and here
// the protocol USB/IP is spoken on the other. It needs root, and is for a virtual machine alone.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <span>
#include <thread>
#include <vector>

#include "reckon/tests/haptics/support/pid_wheel.hpp"

namespace reckon::test {

/// As a board of full speed whose interrupt endpoints move one report in a millisecond, each way.
class UsbipWheel {
 public:
  static constexpr const char* kBus = "/sys/devices/platform/vhci_hcd.0";
  static constexpr const char* kMaker = "Reckon";
  static constexpr const char* kProduct = "FFBoard model";

  explicit UsbipWheel(const PidWheelOptions& options);
  ~UsbipWheel();
  UsbipWheel(const UsbipWheel&) = delete;
  UsbipWheel& operator=(const UsbipWheel&) = delete;

  /// Once it is unplugged; waits until its port is free. @throws std::runtime_error if the kernel
  /// does not take it
  void plug_in();
  void unplug();

  /// Of the wheel, and of this machine.
  [[nodiscard]] static std::chrono::nanoseconds now();
  /// What `use` makes of the wheel as it is now. Any thread.
  template <class Use>
  auto with(Use&& use) {
    const std::lock_guard lock(having_);
    wheel_.run_until(now());
    return use(wheel_);
  }

 private:
  struct Request {
    std::uint32_t number = 0, length = 0;
    bool is_in = false;
    std::uint32_t endpoint = 0;
    std::array<std::uint8_t, 8> setup{};
    std::vector<std::uint8_t> data;
  };

  void serve();
  void move_reports();
  [[nodiscard]] bool take_request();
  void cancel(std::uint32_t number, std::uint32_t victim);
  void control(const Request& request);
  [[nodiscard]] std::vector<std::uint8_t> descriptor(std::uint8_t kind, std::uint8_t index) const;
  void answer(const Request& request, int status, std::span<const std::uint8_t> data);
  void send(std::span<const std::uint32_t> head, std::span<const std::uint8_t> data);
  [[nodiscard]] bool receive(std::span<std::uint8_t> into);

  std::mutex having_;  // of all below
  PidWheel wheel_;
  int socket_ = -1;
  std::deque<Request> in_, out_;
  std::vector<std::uint8_t> sent_;
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

}  // namespace reckon::test
