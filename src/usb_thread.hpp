// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A device on USB as a device of a peer: the device, and the thread that talks with it.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "reckon/haptics/usb/usb_device.hpp"
#include "reckon/haptics/usb/usb_driver.hpp"
#include "reckon/haptics/usb/usb_exchange.hpp"
#include "reckon/haptics/usb/usb_loop.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/real_time_priority.hpp"

namespace reckon::peer {

/// The thread has SCHED_FIFO where the host grants it, below the servo: a report waits for it. It
/// sleeps until the device has sent something, 1 ms at most.
///
///     SteadyClock clock;
///     auto driver = std::make_unique<FalconDriver>(FalconFirmware::load("falcon.bin"));
///     UsbThread falcon(clock, usb_limits(driver->facts(), settings), std::move(driver));
///     options.devices = {{&falcon.device()}};
class UsbThread {
 public:
  static constexpr int kPriority = 45;  ///< of SCHED_FIFO

  /// @param clock that of the servo; outlives this  @param limits see haptics::usb_limits()
  /// @throws std::runtime_error where the host has no USB, std::system_error if no thread can be
  /// made
  UsbThread(const Clock& clock, const haptics::DeviceLimits& limits,
            std::unique_ptr<haptics::UsbDriver> driver);
  ~UsbThread();
  UsbThread(const UsbThread&) = delete;
  UsbThread& operator=(const UsbThread&) = delete;

  /// For the servo; its reading fails while the device is not there.
  [[nodiscard]] haptics::UsbDevice& device() noexcept { return device_; }
  /// Sentences for the user since the last call. Any thread.
  [[nodiscard]] std::vector<std::string> take_notices() { return loop_.take_notices(); }

 private:
  void run() noexcept;

  const Clock& clock_;
  haptics::UsbExchange exchange_;
  haptics::UsbDevice device_;
  haptics::UsbLoop loop_;
  OrdinaryPulse pulse_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace reckon::peer
